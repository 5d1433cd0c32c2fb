#include <utility>
#include <vector>

#include "core/performance/performance.h"
#include "core/performance/record.h"
#include "protocol/cpp/kernel_values.h"
#include "protocol/cpp/performance_document.h"
#include "protocol/cpp/performance_frames.h"
#include "server/cli/face_formats.h"

namespace semblante {
namespace {

constexpr std::size_t max_performance_frames = 500'000;

}  // namespace

bool is_performance(std::string_view text) { return text.find(performance_format) != std::string_view::npos; }

Result<FaceSequence> read_performance_faces(std::string_view text, const FaceReading& reading) {
  const auto script = read_performance(text);
  if (!script) return script.error();
  const auto performance = Performance::compile(*script);
  if (!performance) return performance.error();
  const double rate = reading.rate > 0.0 ? reading.rate : usual_frame_rate;
  auto frames = frames_of(*performance, rate, max_performance_frames);
  if (!frames) return frames.error();
  return FaceSequence{std::move(*frames), rate, {}};
}

Result<std::string> write_performance_faces(const FaceSequence& sequence, const FaceWriting& writing) {
  std::vector<RecordedFrame> frames;
  frames.reserve(sequence.frames.size());
  for (const TimedValues& frame : sequence.frames)
    frames.push_back({static_cast<double>(frame.time), to_kernel_frame(frame.state)});
  auto script = record_performance(frames, {writing.tolerance});
  if (!script) return script.error();
  script->name = writing.name;
  // A performance that cannot be played must not be written: values may be outside the range of their FAP.
  if (const auto performance = Performance::compile(*script); !performance) return performance.error();
  return write_performance(*script);
}

}  // namespace semblante

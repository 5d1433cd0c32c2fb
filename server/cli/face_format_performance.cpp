#include <algorithm>
#include <cmath>
#include <vector>

#include "core/performance/performance.h"
#include "core/performance/record.h"
#include "protocol/cpp/kernel_values.h"
#include "protocol/cpp/performance_document.h"
#include "server/cli/face_formats.h"

namespace semblante {
namespace {

constexpr double usual_rate = 25.0;
constexpr double max_performance_frames = 500'000.0;

}  // namespace

bool is_performance(std::string_view text) { return text.find(performance_format) != std::string_view::npos; }

Result<FaceSequence> read_performance_faces(std::string_view text, const FaceReading& reading) {
  const auto script = read_performance(text);
  if (!script) return script.error();
  const auto performance = Performance::compile(*script);
  if (!performance) return performance.error();
  if (performance->endless())
    return Error{ErrorCode::missing, "/duration", "is required here: nothing but idle life has no end"};
  FaceSequence sequence;
  sequence.rate = reading.rate > 0.0 ? reading.rate : usual_rate;
  const double frames = std::floor(performance->duration() * sequence.rate / 1000.0) + 1.0;
  if (frames > max_performance_frames)
    return Error{
        ErrorCode::too_large, "/duration",
        "gives more than " + std::to_string(static_cast<int>(max_performance_frames)) + " frames at this rate"};
  for (int k = 0; k < frames; ++k) {
    const double ms = k * 1000.0 / sequence.rate;
    sequence.frames.push_back({static_cast<std::uint32_t>(std::lround(ms)), to_values(performance->frame_at(ms))});
  }
  return sequence;
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

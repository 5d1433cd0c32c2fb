#include "protocol/cpp/quantizers.h"
#include "server/cli/face_formats.h"
#include "server/recordings/recording_reader.h"

namespace semblante {
namespace {

constexpr std::uint64_t max_recording_frames = 500'000;

}  // namespace

Result<FaceSequence> read_recording_faces(std::string_view text, const FaceReading& /*reading*/) {
  using namespace recordings;
  auto reader = RecordingReader::open(bytes_in_memory({text.begin(), text.end()}), Check::everything);
  if (!reader) return reader.error();
  if (reader->frames() == 0) return Error{ErrorCode::empty, "", "the recording has no frame"};
  if (reader->frames() > max_recording_frames)
    return Error{ErrorCode::too_large, "", "more than " + std::to_string(max_recording_frames) + " frames"};
  FaceSequence sequence;
  if (reader->torn_bytes() > 0) {
    sequence.warnings.push_back("byte " + std::to_string(reader->whole_bytes()) + ": " + reader->torn_reason() +
                                ": what follows is left out");
  }
  if (reader->lost() > 0)
    sequence.warnings.push_back(std::to_string(reader->lost()) + " frames of the stream were not recorded");
  const QuantizerSteps steps = quantizers_of(reader->header());
  sequence.frames.reserve(reader->frames());
  RecordingCursor cursor(std::make_shared<const RecordingReader>(*std::move(reader)), 0);
  for (; cursor.frame() != nullptr; cursor.advance())
    sequence.frames.push_back({cursor.time(), to_values(cursor.frame()->state, steps)});
  if (cursor.error()) return *cursor.error();
  return sequence;
}

}  // namespace semblante

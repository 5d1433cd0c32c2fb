#include "protocol/cpp/json_codec.h"
#include "server/cli/face_formats.h"

namespace semblante {

Result<FaceSequence> read_frames_faces(std::string_view text, const FaceReading& /*reading*/) {
  auto frames = decode_json_values(text);
  if (!frames) return frames.error();
  return FaceSequence{*std::move(frames), 0, {}};
}

Result<std::string> write_frames_faces(const FaceSequence& sequence, const FaceWriting& /*writing*/) {
  return encode_json_values(sequence.frames);
}

}  // namespace semblante

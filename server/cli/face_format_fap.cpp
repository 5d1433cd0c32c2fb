#include "protocol/cpp/fap_file.h"
#include "server/cli/face_formats.h"

namespace semblante {

Result<FaceSequence> read_fap_faces(std::string_view text, const FaceReading& reading) {
  const auto read = read_fap_file(text);
  if (!read) return read.error();
  auto frames = frames_of(read->file, reading.fap_meaning);
  if (!frames) return frames.error();
  FaceSequence sequence{*std::move(frames), read->file.rate, {}};
  for (const auto& warning : read->warnings) sequence.warnings.push_back(to_sentence(warning));
  return sequence;
}

Result<std::string> write_fap_faces(const FaceSequence& sequence, const FaceWriting& writing) {
  FapFileStyle style;
  style.rate = writing.rate > 0 ? writing.rate : sequence.rate;
  style.name = writing.name;
  const auto file = fap_file_of(sequence.frames, style);
  if (!file) return file.error();
  return write_fap_file(*file);
}

}  // namespace semblante

#include "server/cli/face_formats.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "core/types/letter_case.h"
#include "server/cli/command_failure.h"
#include "server/cli/files.h"

namespace semblante {
namespace {

constexpr std::size_t max_file_bytes = std::size_t{64} << 20U;

/// Among formats with the same extension, the first that recognizes a text is used; one that recognizes all texts is
/// last.
constexpr std::array formats = {
    FaceFormat{"fap", ".fap", "the FAP file of MPEG-4's reference encoder", nullptr, read_fap_faces, write_fap_faces},
    FaceFormat{"arkit-csv", ".csv", "a take of Live Link Face: ARKit's 52 coefficients and the angles of the head",
               nullptr, read_live_link_faces, write_live_link_faces},
    FaceFormat{"recording", ".srec",
               "a recording of a stream, as GET /v1/recordings/{id}/content?format=recording gives it", nullptr,
               read_recording_faces, nullptr},
    FaceFormat{"performance", ".json", "a performance: sampled --rate times a second when read, recorded when written",
               is_performance, read_performance_faces, write_performance_faces},
    FaceFormat{"frames", ".json", "the frames of POST /v1/streams/{id}/frames, as many as you like", nullptr,
               read_frames_faces, write_frames_faces},
};

template <class Filter>
std::string names(const Filter& filter) {
  std::string text;
  for (const FaceFormat& format : formats) {
    if (filter(format)) text.append(text.empty() ? "" : ", ").append(format.name);
  }
  return text;
}

const FaceFormat* by_name(const std::string& name) {
  const auto found = std::find_if(formats.begin(), formats.end(), [&](const auto& f) { return f.name == name; });
  return found == formats.end() ? nullptr : &*found;
}

/// The format of a path, among those accepted by `filter`.
template <class Filter>
const FaceFormat* by_path(const std::string& path, const Filter& filter) {
  const std::string extension = lower_case(std::filesystem::path(path).extension().string());
  const auto found = std::find_if(formats.begin(), formats.end(),
                                  [&](const auto& f) { return f.extension == extension && filter(f); });
  return found == formats.end() ? nullptr : &*found;
}

[[noreturn]] void refuse_file(const std::string& path, const std::string& reason) {
  throw CommandFailure(CommandFailure::bad_input, path + ": " + reason);
}

}  // namespace

std::span<const FaceFormat> face_formats() { return formats; }

std::string readable_face_formats() {
  return names([](const FaceFormat& format) { return format.read != nullptr; });
}

std::string writable_face_formats() {
  return names([](const FaceFormat& format) { return format.write != nullptr; });
}

FaceSequence read_faces(const std::string& path, const std::string& format, const FaceReading& reading) {
  const auto bytes = read_file(path, max_file_bytes);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const FaceFormat* const chosen =
      format.empty() ? by_path(path,
                               [&](const FaceFormat& f) {
                                 return f.read != nullptr && (f.recognizes == nullptr || f.recognizes(text));
                               })
                     : by_name(format);
  if (chosen == nullptr || chosen->read == nullptr) {
    refuse_file(path, format.empty()
                          ? "its format cannot be told from its name; say one of " + readable_face_formats()
                          : "no format '" + format + "' can be read; it is one of " + readable_face_formats());
  }
  auto sequence = chosen->read(text, reading);
  if (!sequence) fail(path, sequence.error());
  for (auto& warning : sequence->warnings) warning.insert(0, path + ": ");
  return *std::move(sequence);
}

std::string write_faces(const FaceSequence& sequence, const std::string& path, const std::string& format,
                        const FaceWriting& writing) {
  const FaceFormat* const chosen =
      format.empty() ? by_path(path, [](const FaceFormat& f) { return f.write != nullptr && f.recognizes == nullptr; })
                     : by_name(format);
  if (chosen == nullptr || chosen->write == nullptr) {
    refuse_file(path, format.empty()
                          ? "its format cannot be told from its name; say one of " + writable_face_formats()
                          : "no format '" + format + "' can be written; it is one of " + writable_face_formats());
  }
  auto text = chosen->write(sequence, writing);
  if (!text) fail(path, text.error());
  return *std::move(text);
}

}  // namespace semblante

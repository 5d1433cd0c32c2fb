#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/cpp/face_values.h"
#include "protocol/cpp/fap_file_frames.h"

namespace semblante {

/// A face animation, independent of its file format; the data of `convert` and `deform --frames`.
struct FaceSequence {
  std::vector<TimedValues> frames;    ///< at least one
  double rate = 0;                    ///< frames per second stated by the format; 0: none
  std::vector<std::string> warnings;  ///< as text
};

/// Options of a reader.
struct FaceReading {
  FapFileMeaning fap_meaning;
  double rate = 0;  ///< frames per second for formats without frames; 0: 25
};

/// Options of a writer.
struct FaceWriting {
  double rate = 0;  ///< frames per second; 0: that of the sequence, or estimated from its times
  std::string name = "semblante";
  double tolerance = 0.5;  ///< of thinning keys: in quantizer steps
};

/// A file format of face animations. To add one: a file face_format_NAME.cpp with its two functions and a line in
/// face_formats.cpp; commands and their help follow.
struct FaceFormat {
  std::string_view name;       ///< "fap": for --in-format and --out-format
  std::string_view extension;  ///< ".fap": selects the format when none is stated
  std::string_view meaning;    ///< for --help
  /// Whether a text has this format; distinguishes formats with the same extension. Null: the only format with its
  /// extension, or the one used for writing.
  bool (*recognizes)(std::string_view text) = nullptr;
  /// Null: cannot be read. Errors name line or JSON pointer in `where`.
  Result<FaceSequence> (*read)(std::string_view text, const FaceReading& reading) = nullptr;
  /// Null: cannot be written.
  Result<std::string> (*write)(const FaceSequence& sequence, const FaceWriting& writing) = nullptr;
};

std::span<const FaceFormat> face_formats();

/// The names of the readable (or writable) formats, as "fap, frames".
std::string readable_face_formats();
std::string writable_face_formats();

/// Reads the file at `path`. `format`: a name, or empty: by the path's extension and the text. Throws CommandFailure.
FaceSequence read_faces(const std::string& path, const std::string& format, const FaceReading& reading);

/// The text of `sequence` in `format`, or, if that is empty, in the format of the path's extension. Throws
/// CommandFailure.
std::string write_faces(const FaceSequence& sequence, const std::string& path, const std::string& format,
                        const FaceWriting& writing);

// Each in face_format_NAME.cpp.
Result<FaceSequence> read_fap_faces(std::string_view text, const FaceReading& reading);
Result<std::string> write_fap_faces(const FaceSequence& sequence, const FaceWriting& writing);
Result<FaceSequence> read_live_link_faces(std::string_view text, const FaceReading& reading);
Result<std::string> write_live_link_faces(const FaceSequence& sequence, const FaceWriting& writing);
bool is_performance(std::string_view text);
Result<FaceSequence> read_performance_faces(std::string_view text, const FaceReading& reading);
Result<std::string> write_performance_faces(const FaceSequence& sequence, const FaceWriting& writing);
Result<FaceSequence> read_recording_faces(std::string_view text, const FaceReading& reading);
Result<FaceSequence> read_frames_faces(std::string_view text, const FaceReading& reading);
Result<std::string> write_frames_faces(const FaceSequence& sequence, const FaceWriting& writing);

}  // namespace semblante

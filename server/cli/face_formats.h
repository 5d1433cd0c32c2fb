#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/cpp/face_values.h"
#include "protocol/cpp/fap_file_frames.h"

namespace semblante {

/// Faces in time, in whatever format they came: what `convert` and `deform --frames` work on.
struct FaceSequence {
  std::vector<TimedValues> frames;    ///< at least one
  double rate = 0;                    ///< frames a second that the format states; 0: it states none
  std::vector<std::string> warnings;  ///< in words
};

/// What a reader is told beyond the file.
struct FaceReading {
  FapFileMeaning fap_meaning;
  double rate = 0;  ///< frames a second of what has no frames of its own; 0: 25
};

/// What a writer is told beyond the frames.
struct FaceWriting {
  double rate = 0;  ///< frames a second; 0: the sequence's own, or told from its times
  std::string name = "semblante";
  double tolerance = 0.5;  ///< of what is thinned out: in quantizer steps
};

/// A file format of faces in time. To add one: a file face_format_NAME.cpp with its two functions and a line in
/// face_formats.cpp; commands and their help follow.
struct FaceFormat {
  std::string_view name;       ///< "fap": for --in-format and --out-format
  std::string_view extension;  ///< ".fap": what a path without a stated format is taken for
  std::string_view meaning;    ///< for --help
  /// Whether a text looks like it: told apart among formats of one extension. Null: the only one of its extension, or
  /// the one that a path to be written means.
  bool (*recognizes)(std::string_view text) = nullptr;
  /// Null: cannot be read. Errors name line or JSON pointer in `where`.
  Result<FaceSequence> (*read)(std::string_view text, const FaceReading& reading) = nullptr;
  /// Null: cannot be written.
  Result<std::string> (*write)(const FaceSequence& sequence, const FaceWriting& writing) = nullptr;
};

std::span<const FaceFormat> face_formats();

/// The names of those that can be read (or written), as "fap, frames".
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

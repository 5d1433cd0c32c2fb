#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/result.h"

/// The ASCII FAP file (.fap), the input format of MPEG-4's reference encoder, also used by players. Rules:
/// protocol/FAP_FILE.md.
namespace semblante {

/// FAP 1 in a file. Selects 0..14, blend 0..63.
struct FapFileViseme {
  std::uint8_t select1 = 0, select2 = 0, blend = 0;
  std::uint8_t viseme_def = 0;  ///< 0 or 1; kept, of no effect here
  friend bool operator==(const FapFileViseme&, const FapFileViseme&) = default;
};

/// FAP 2 in a file. Selects 0..6, intensities 0..63.
struct FapFileExpression {
  std::uint8_t select1 = 0, intensity1 = 0, select2 = 0, intensity2 = 0;
  std::uint8_t init_face = 0, expression_def = 0;  ///< 0 or 1; kept, of no effect here
  friend bool operator==(const FapFileExpression&, const FapFileExpression&) = default;
};

struct FapFileFrame {
  std::uint32_t number = 0;  ///< from 0, rising; gaps are allowed
  std::bitset<69> present;   ///< by FAP number: the FAPs that the frame has; bit 0 unused
  FapFileViseme viseme;      ///< neutral unless FAP 1 is present
  FapFileExpression expression;
  std::array<double, 69> value{};  ///< by FAP number 3..68, FAP units, within +-1e9; 0 unless present

  friend bool operator==(const FapFileFrame&, const FapFileFrame&) = default;
};

/// The content of a file, independent of its deviations from the usual form.
struct FapFile {
  double rate = 25;                  ///< frames a second, 0.001..1000
  std::string name;                  ///< printable ASCII without blanks; has no effect
  std::vector<FapFileFrame> frames;  ///< by rising number, the first is 0; at least one

  friend bool operator==(const FapFile&, const FapFile&) = default;
};

/// Deviations from the usual form that the reader accepts, and how they were read.
enum class FapFileOddity : std::uint8_t {
  other_version,             ///< neither 2.0, 2.1 nor 2.2: read like these
  blank_in_name,             ///< joined by _
  count_differs,             ///< the number of frames in the header is wrong: all frames of the file are used
  extra_flag,                ///< 69 flags: the last is dropped
  few_values,                ///< flags without a value: absent
  more_values,               ///< values without a flag: dropped
  not_finite,                ///< inf or nan: zero
  first_number_not_zero,     ///< the first number is not 0: it is changed to 0
  numbers_not_rising,        ///< sorted; of two frames with the same number the later one is used
  numbers_left_out,          ///< there are gaps
  single_number_viseme,      ///< FAP 1 as one number 0..14: that viseme in full
  packed_viseme,             ///< FAP 1 as one number of six digits: unpacked
  single_number_expression,  ///< FAP 2 as one number 0..6: that expression in full
  unknown_select,            ///< FAP 1 or 2 is not a viseme or expression: absent
  strength_out_of_range,     ///< blend or intensity outside 0..63: clamped
  strength_not_whole,        ///< blend or intensity with a fraction: rounded
};
std::string_view to_string(FapFileOddity oddity);

struct FapFileWarning {
  FapFileOddity oddity{};
  std::uint32_t line = 0;   ///< the first line with the deviation, from 1
  std::uint32_t count = 0;  ///< number of such lines or values
  friend bool operator==(const FapFileWarning&, const FapFileWarning&) = default;
};

/// A readable text: "line 3: 69 flags instead of 68: the last is dropped (108 times)".
std::string to_sentence(const FapFileWarning& warning);

struct FapFileReading {
  FapFile file;
  std::vector<FapFileWarning> warnings;  ///< at most one per kind, in the order of the enumeration
};

struct FapFileLimits {
  std::size_t bytes = std::size_t{64} << 20U;
  std::size_t line_bytes = 8192;
  std::size_t frames = 100'000;
};
/// Largest frame number relative to the first, at any rate: eleven hours at 25 frames per second.
inline constexpr std::uint32_t max_fap_file_number = 1'000'000;

/// Errors: malformed (no header, no frame, an invalid mask or number), truncated (a mask without values),
/// out_of_range, too_large. `where` is "line 12" or "line 12, word 3".
Result<FapFileReading> read_fap_file(std::string_view text, const FapFileLimits& limits = {});

/// Writes version 2.1, 68 flags, frames from 0, LF, one blank as separator; integers as such, others in the shortest
/// exact form. Reading the result gives `file` without warnings except for gaps in the frame numbers.
std::string write_fap_file(const FapFile& file);

}  // namespace semblante

#include <array>
#include <utility>

#include "core/types/decimal.h"
#include "protocol/cpp/fap_file.h"

namespace semblante {
namespace {

struct Words {
  std::string_view name, sentence;
};

constexpr std::array<Words, 16> words_of = {{
    {"other_version", "a version other than 2.0, 2.1 and 2.2: read like these"},
    {"blank_in_name", "blanks in the name of the header: joined"},
    {"count_differs", "the number of frames in the header differs from the file: all frames of the file are used"},
    {"extra_flag", "69 flags instead of 68: the last is dropped"},
    {"few_values", "fewer values than flags: the last flags have none and are absent"},
    {"more_values", "more values than flags: the last are dropped"},
    {"not_finite", "a value is infinite or not a number: zero instead"},
    {"first_number_not_zero", "frames are not counted from 0: the first is 0"},
    {"numbers_not_rising",
     "frame numbers do not increase: the frames are sorted, and of two with the same number the later one is used"},
    {"numbers_left_out", "frame numbers have gaps"},
    {"single_number_viseme", "FAP 1 as one number instead of four: that viseme in full"},
    {"packed_viseme", "FAP 1 packed in one number: unpacked"},
    {"single_number_expression", "FAP 2 as one number instead of six: that expression in full"},
    {"unknown_select", "FAP 1 or 2 is not a viseme or expression: absent"},
    {"strength_out_of_range", "a blend or intensity outside 0..63: clamped"},
    {"strength_not_whole", "a blend or intensity that is not whole: rounded"},
}};
static_assert(words_of.size() == static_cast<std::size_t>(FapFileOddity::strength_not_whole) + 1);

}  // namespace

std::string_view to_string(FapFileOddity oddity) { return words_of[static_cast<std::size_t>(oddity)].name; }

std::string to_sentence(const FapFileWarning& warning) {
  std::string text = "line " + natural_text(warning.line) + ": ";
  text += words_of[static_cast<std::size_t>(warning.oddity)].sentence;
  if (warning.count > 1) text += " (" + natural_text(warning.count) + " times)";
  return text;
}

}  // namespace semblante

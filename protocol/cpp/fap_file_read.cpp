#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/types/decimal.h"
#include "protocol/cpp/face_frame.h"
#include "protocol/cpp/fap_file.h"
#include "protocol/cpp/fap_number.h"

namespace semblante {
namespace {

constexpr std::size_t viseme_fields = 4;
constexpr std::size_t expression_fields = 6;
constexpr double max_rate = 1000.0;
constexpr double min_rate = 0.001;
constexpr std::size_t max_name_bytes = 256;
/// The packed form of FAP 1: (select1 * 10000 + 100000) + (select2 * 100 + 1000) + (blend + 10).
constexpr int packed_base = 101'010;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

/// The words of a line and its number.
struct Line {
  std::uint32_t number = 0;
  std::vector<std::string_view> words;
};

std::string line_of(std::uint32_t line) { return "line " + natural_text(line); }

/// A word of the file in a message: short and printable.
std::string quoted(std::string_view word) {
  constexpr std::size_t most = 24;
  std::string text = "\"";
  for (const char c : word.substr(0, most)) text += c > ' ' && c < '\x7f' ? c : '?';
  return text + (word.size() > most ? "...\"" : "\"");
}

/// Iterates over the lines that are not empty and not comments (#). Line ends are LF, CR LF and CR.
class Lines {
 public:
  Lines(std::string_view text, std::size_t max_line, std::optional<Error>& fault)
      : rest_(text), max_line_(max_line), fault_(fault) {
    if (rest_.substr(0, 3) == "\xEF\xBB\xBF") rest_.remove_prefix(3);
  }

  std::optional<Line> next() {
    while (!rest_.empty() && !fault_) {
      ++number_;
      const std::size_t end = rest_.find_first_of("\r\n");
      const std::string_view text = rest_.substr(0, end);
      if (text.size() > max_line_) {
        fault_ = Error{ErrorCode::too_large, line_of(number_), "has more than " + natural_text(max_line_) + " bytes"};
        return std::nullopt;
      }
      if (end == std::string_view::npos) {
        rest_ = {};
      } else {
        rest_.remove_prefix(end + (rest_.substr(end, 2) == "\r\n" ? 2 : 1));
      }
      if (text.starts_with('#')) continue;
      Line line{number_, {}};
      for (std::size_t i = 0; i < text.size();) {
        std::size_t stop = i;
        while (stop < text.size() && !is_blank(text[stop])) ++stop;
        if (stop > i) line.words.push_back(text.substr(i, stop - i));
        i = stop + 1;
      }
      if (!line.words.empty()) return line;
    }
    return std::nullopt;
  }
  [[nodiscard]] std::uint32_t number() const { return number_; }

 private:
  std::string_view rest_;
  std::size_t max_line_;
  std::optional<Error>& fault_;
  std::uint32_t number_ = 0;
};

/// Joins words with _ and replaces characters that are not printable ASCII by _.
std::string tidy_name(std::span<const std::string_view> words) {
  std::string name;
  for (const auto word : words) {
    if (!name.empty() && name.back() != '_') name += '_';
    for (const char c : word) {
      if (c > ' ' && c < '\x7f') {
        name += c;
      } else if (name.empty() || name.back() != '_') {
        name += '_';
      }
    }
  }
  return name.substr(0, max_name_bytes);
}

class Reader {
 public:
  Reader(std::string_view text, const FapFileLimits& limits)
      : lines_(text, limits.line_bytes, fault_), limits_(limits) {}

  Result<FapFileReading> read() {
    const double announced = read_header();
    while (const auto mask = lines_.next()) read_frame(*mask);
    if (reading_.file.frames.empty()) fail(ErrorCode::malformed, lines_.number(), "the file ends without a frame");
    if (!fault_) order_frames();
    if (fault_) return *std::move(fault_);
    if (announced != static_cast<double>(lines_of_frames_.size())) {
      note(FapFileOddity::count_differs, header_line_);
    }
    return std::move(reading_);
  }

 private:
  /// Records the FIRST error; reading continues with default values until a loop checks for it.
  void fail(ErrorCode code, std::uint32_t line, std::string message) {
    if (!fault_) fault_ = Error{code, line_of(line), std::move(message)};
  }
  void fail(ErrorCode code, const Line& line, std::size_t word, std::string message) {
    if (!fault_) fault_ = Error{code, line_of(line.number) + ", word " + natural_text(word + 1), std::move(message)};
  }
  /// Parses a word as a number; anything else is malformed. NaN and infinities are accepted.
  double number_at(const Line& line, std::size_t word) {
    const auto value = read_fap_number(line.words[word]);
    if (!value) fail(ErrorCode::malformed, line, word, quoted(line.words[word]) + " is no number");
    return value.value_or(0.0);
  }

  /// Warnings are in the order of the oddities.
  void note(FapFileOddity oddity, std::uint32_t line) {
    auto at = reading_.warnings.begin();
    while (at != reading_.warnings.end() && at->oddity < oddity) ++at;
    if (at != reading_.warnings.end() && at->oddity == oddity) {
      ++at->count;
    } else {
      reading_.warnings.insert(at, {oddity, line, 1});
    }
  }

  /// Reads `version name rate count`; the name may contain blanks. Returns the count.
  double read_header() {
    const auto line = lines_.next();
    if (!line) {
      fail(ErrorCode::malformed, std::max(1U, lines_.number()), "the file has no header");
      return 0.0;
    }
    header_line_ = line->number;
    const auto& words = line->words;
    if (words.size() < 4) {
      fail(ErrorCode::malformed, line->number,
           "the header must be: version, name, frames per second, number of frames");
      return 0.0;
    }
    if (words[0] != "2.0" && words[0] != "2.1" && words[0] != "2.2") {
      if (!read_fap_number(words[0])) {
        fail(ErrorCode::malformed, *line, 0, quoted(words[0]) + " is no version of a .fap file, as 2.1 is");
      }
      note(FapFileOddity::other_version, line->number);
    }
    const std::size_t rate = words.size() - 2;
    reading_.file.rate = number_at(*line, rate);
    if (!(reading_.file.rate >= min_rate && reading_.file.rate <= max_rate)) {
      fail(ErrorCode::out_of_range, *line, rate, "the frames per second must be 0.001 to 1000");
    }
    if (rate > 2) note(FapFileOddity::blank_in_name, line->number);
    reading_.file.name = tidy_name(std::span(words).subspan(1, rate - 1));
    return number_at(*line, rate + 1);
  }

  void read_frame(const Line& mask) {
    if (reading_.file.frames.size() >= limits_.frames) {
      return fail(ErrorCode::too_large, mask.number, "a file has at most " + natural_text(limits_.frames) + " frames");
    }
    auto frame = read_mask(mask);
    if (fault_) return;
    const auto values = lines_.next();
    if (!values) return fail(ErrorCode::truncated, mask.number, "the file ends after this mask, without its values");
    read_values(*values, frame);
    reading_.file.frames.push_back(frame);
    lines_of_frames_.push_back(values->number);
  }

  FapFileFrame read_mask(const Line& line) {
    FapFileFrame frame;
    const auto& words = line.words;
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (i > last_low_level_fap || (words[i] != "0" && words[i] != "1")) {
        fail(ErrorCode::malformed, line, i,
             i > last_low_level_fap ? "a mask has 68 flags (69 are taken), this has more"
                                    : "a flag of a mask is 0 or 1, not " + quoted(words[i]));
        break;
      }
      if (i < last_low_level_fap) frame.present[i + 1] = words[i] == "1";
    }
    if (words.size() < last_low_level_fap) {
      fail(ErrorCode::malformed, line.number,
           "a mask has 68 flags (69 are taken), this has " + natural_text(words.size()));
    }
    if (words.size() > last_low_level_fap) note(FapFileOddity::extra_flag, line.number);
    return frame;
  }

  void read_values(const Line& line, FapFileFrame& frame) {
    const double number = number_at(line, 0);
    if (!(number >= 0 && number <= 2.0 * max_fap_file_number) || number != std::floor(number)) {
      return fail(ErrorCode::out_of_range, line, 0,
                  quoted(line.words[0]) + " is no frame number: those are whole, from 0 to " +
                      natural_text(std::uint64_t{2} * max_fap_file_number));
    }
    frame.number = static_cast<std::uint32_t>(number);

    // Some files write FAPs 1 and 2 as one number each; the count of numbers is unambiguous.
    const std::size_t given = line.words.size() - 1;
    std::size_t viseme = frame.present[1] ? viseme_fields : 0;
    std::size_t expression = frame.present[2] ? expression_fields : 0;
    const std::size_t others = frame.present.count() - (frame.present[1] ? 1 : 0) - (frame.present[2] ? 1 : 0);
    for (const std::size_t v : {viseme_fields, std::size_t{1}}) {
      for (const std::size_t e : {expression_fields, std::size_t{1}}) {
        const std::size_t short_viseme = frame.present[1] ? v : 0;
        const std::size_t short_expression = frame.present[2] ? e : 0;
        if (short_viseme + short_expression + others == given) viseme = short_viseme, expression = short_expression;
      }
    }
    if (given < viseme + expression + others) note(FapFileOddity::few_values, line.number);
    if (given > viseme + expression + others) note(FapFileOddity::more_values, line.number);

    std::size_t at = 1;
    if (frame.present[1]) read_viseme(line, at, viseme, frame);
    if (frame.present[2]) read_expression(line, at, expression, frame);
    for (std::size_t fap = 3; fap <= last_low_level_fap; ++fap) {
      if (!frame.present[fap]) continue;
      if (at >= line.words.size()) {
        frame.present.reset(fap);
      } else {
        frame.value[fap] = value_at(line, at++);
      }
    }
    // Extra values are dropped, but must be numbers: otherwise this is not a line of values.
    for (; at < line.words.size(); ++at) number_at(line, at);
  }

  double value_at(const Line& line, std::size_t word) {
    const double value = number_at(line, word);
    if (!std::isfinite(value)) {
      note(FapFileOddity::not_finite, line.number);
      return 0.0;
    }
    if (std::abs(value) > max_fap_value) {
      fail(ErrorCode::out_of_range, line, word, quoted(line.words[word]) + " is beyond 1e9 FAP units");
      return 0.0;
    }
    return value;
  }

  /// The numbers of a field group; nullopt when the line ends within it.
  std::optional<std::vector<double>> fields_at(const Line& line, std::size_t& at, std::size_t count) {
    std::vector<double> fields;
    for (; fields.size() < count && at < line.words.size(); ++at) fields.push_back(number_at(line, at));
    if (fields.size() < count) return std::nullopt;
    return fields;
  }

  std::optional<std::uint8_t> whole(double value, int most) {
    if (!(value >= 0 && value <= most) || value != std::floor(value)) return std::nullopt;
    return static_cast<std::uint8_t>(value);
  }

  std::uint8_t strength(const Line& line, double value) {
    if (std::isnan(value) || value < 0 || value > max_blend) {
      note(FapFileOddity::strength_out_of_range, line.number);
      return value > max_blend ? max_blend : std::uint8_t{0};
    }
    if (value != std::floor(value)) note(FapFileOddity::strength_not_whole, line.number);
    return static_cast<std::uint8_t>(std::floor(value + 0.5));
  }

  void read_viseme(const Line& line, std::size_t& at, std::size_t count, FapFileFrame& frame) {
    const auto fields = fields_at(line, at, count);
    frame.present.reset(1);
    if (!fields) return;
    if (count == 1) {
      const double number = fields->front();
      const int packed = number >= packed_base && number < 1e6 && number == std::floor(number)
                             ? static_cast<int>(number) - packed_base
                             : -1;
      if (const auto select = whole(number, max_viseme)) {
        frame.viseme = {*select, 0, max_blend, 0};
        note(FapFileOddity::single_number_viseme, line.number);
      } else if (packed >= 0 && packed / 10'000 <= max_viseme && packed / 100 % 100 <= max_viseme &&
                 packed % 100 <= max_blend) {
        frame.viseme = {static_cast<std::uint8_t>(packed / 10'000), static_cast<std::uint8_t>(packed / 100 % 100),
                        static_cast<std::uint8_t>(packed % 100), 0};
        note(FapFileOddity::packed_viseme, line.number);
      } else {
        return note(FapFileOddity::unknown_select, line.number);
      }
    } else {
      const auto select1 = whole((*fields)[0], max_viseme);
      const auto select2 = whole((*fields)[1], max_viseme);
      const auto def = whole((*fields)[3], 1);
      if (!select1 || !select2 || !def) return note(FapFileOddity::unknown_select, line.number);
      frame.viseme = {*select1, *select2, strength(line, (*fields)[2]), *def};
    }
    frame.present.set(1);
  }

  void read_expression(const Line& line, std::size_t& at, std::size_t count, FapFileFrame& frame) {
    const auto fields = fields_at(line, at, count);
    frame.present.reset(2);
    if (!fields) return;
    const auto select1 = whole(fields->front(), max_expression);
    if (count == 1) {
      if (!select1) return note(FapFileOddity::unknown_select, line.number);
      frame.expression = {*select1, max_blend, 0, 0, 0, 0};
      note(FapFileOddity::single_number_expression, line.number);
    } else {
      const auto select2 = whole((*fields)[2], max_expression);
      const auto init = whole((*fields)[4], 1);
      const auto def = whole((*fields)[5], 1);
      if (!select1 || !select2 || !init || !def) return note(FapFileOddity::unknown_select, line.number);
      frame.expression = {*select1, strength(line, (*fields)[1]), *select2, strength(line, (*fields)[3]), *init, *def};
    }
    frame.present.set(2);
  }

  /// By number; of frames with the same number the last one stays.
  static void sort_frames(std::vector<FapFileFrame>& frames) {
    std::vector<std::uint64_t> order(frames.size());  // number, then place in the file
    for (std::size_t i = 0; i < frames.size(); ++i) order[i] = std::uint64_t{frames[i].number} << 32U | i;
    const auto does_not_rise = [](std::uint64_t a, std::uint64_t b) { return a >> 32U >= b >> 32U; };
    if (std::adjacent_find(order.begin(), order.end(), does_not_rise) == order.end()) return;
    std::make_heap(order.begin(), order.end());
    std::sort_heap(order.begin(), order.end());
    std::vector<FapFileFrame> sorted;
    sorted.reserve(frames.size());
    for (const std::uint64_t key : order) {
      const FapFileFrame& frame = frames[key & 0xffffffffU];
      if (!sorted.empty() && sorted.back().number == frame.number) {
        sorted.back() = frame;
      } else {
        sorted.push_back(frame);
      }
    }
    frames = std::move(sorted);
  }

  /// Sorts frames by number, starting from 0, without duplicates.
  void order_frames() {
    auto& frames = reading_.file.frames;
    for (std::size_t i = 1; i < frames.size(); ++i) {
      if (frames[i].number <= frames[i - 1].number) note(FapFileOddity::numbers_not_rising, lines_of_frames_[i]);
    }
    sort_frames(frames);
    const std::uint32_t first = frames.front().number;
    if (first != 0) note(FapFileOddity::first_number_not_zero, lines_of_frames_.front());
    if (frames.back().number - first > max_fap_file_number) {
      fail(ErrorCode::out_of_range, lines_of_frames_.back(),
           "the frame numbers span more than " + natural_text(max_fap_file_number));
    }
    for (auto& frame : frames) frame.number -= first;
    for (std::size_t i = 1; i < frames.size(); ++i) {
      if (frames[i].number != frames[i - 1].number + 1) note(FapFileOddity::numbers_left_out, header_line_);
    }
  }

  std::optional<Error> fault_;
  Lines lines_;
  const FapFileLimits& limits_;
  FapFileReading reading_;
  std::uint32_t header_line_ = 0;
  std::vector<std::uint32_t> lines_of_frames_;  ///< the line of each frame's values, in the order of the file
};

}  // namespace

Result<FapFileReading> read_fap_file(std::string_view text, const FapFileLimits& limits) {
  if (text.size() > limits.bytes) {
    return Error{ErrorCode::too_large, "", "a .fap file has at most " + natural_text(limits.bytes) + " bytes"};
  }
  return Reader(text, limits).read();
}

}  // namespace semblante

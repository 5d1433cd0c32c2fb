#include "server/app/config_file.h"

#include <algorithm>
#include <optional>

namespace semblante {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_of_key(char c) { return is_digit(c) || is_letter(c) || c == '-' || c == '_'; }
bool is_of_bare_value(char c) { return is_of_key(c) || c == '.' || c == '+' || c == ':'; }

/// An integer or a decimal fraction, with TOML's underscores between digits.
bool is_number(std::string_view text) {
  if (!text.empty() && (text.front() == '+' || text.front() == '-')) text.remove_prefix(1);
  std::size_t points = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool inside = i > 0 && i + 1 < text.size() && is_digit(text[i - 1]) && is_digit(text[i + 1]);
    if (text[i] == '.') ++points;
    if (!is_digit(text[i]) && !(inside && (text[i] == '.' || text[i] == '_'))) return false;
  }
  return !text.empty() && points < 2;
}

class ConfigReader {
 public:
  explicit ConfigReader(std::string_view text) : text_(text) {
    if (text_.substr(0, 3) == "\xEF\xBB\xBF") text_.remove_prefix(3);
  }

  Result<std::vector<ConfigEntry>> read() {
    std::vector<ConfigEntry> entries;
    for (skip_empty_lines(); !at_end(); skip_empty_lines()) {
      ConfigEntry entry;
      entry.line = line_;
      if (!read_entry(entry)) return *error_;
      for (const auto& earlier : entries)
        if (earlier.key == entry.key)
          return Error{
              ErrorCode::invalid_argument, std::to_string(entry.line),
              "the key " + entry.key + " is there a second time; the first is in line " + std::to_string(earlier.line)};
      entries.push_back(std::move(entry));
    }
    return entries;
  }

 private:
  [[nodiscard]] bool at_end() const { return text_.empty(); }
  [[nodiscard]] char next() const { return text_.empty() ? '\0' : text_.front(); }

  char take() {
    const char c = text_.front();
    text_.remove_prefix(1);
    if (c == '\n') ++line_;
    return c;
  }

  bool fail(std::string message, ErrorCode code = ErrorCode::malformed) {
    error_ = Error{code, std::to_string(line_), std::move(message)};
    return false;
  }

  void skip_blanks() {
    while (next() == ' ' || next() == '\t') take();
  }
  /// Blanks, and the comment up to the end of the line.
  void skip_comment() {
    skip_blanks();
    if (next() == '#')
      while (!at_end() && next() != '\n') take();
    if (text_.substr(0, 2) == "\r\n") take();
  }
  void skip_empty_lines() {
    for (skip_comment(); next() == '\n'; skip_comment()) take();
  }

  std::string take_while(bool (*belongs)(char)) {
    const auto end = std::find_if_not(text_.begin(), text_.end(), belongs);
    std::string word(text_.begin(), end);
    text_.remove_prefix(word.size());
    return word;
  }

  bool read_entry(ConfigEntry& entry) {
    if (next() == '[') return fail("tables are not supported: all keys are at top level", ErrorCode::unsupported);
    entry.key = take_while(is_of_key);
    if (entry.key.empty()) return fail("a key is expected: letters, digits, - and _");
    skip_blanks();
    if (next() != '=') return fail("\"=\" is expected after the key " + entry.key);
    take();
    skip_blanks();
    entry.is_array = next() == '[';
    if (!(entry.is_array ? read_array(entry.values) : read_value(entry.values))) return false;
    skip_comment();
    return at_end() || next() == '\n' || fail("the line goes on after the value of " + entry.key);
  }

  bool read_array(std::vector<std::string>& values) {
    take();
    for (skip_empty_lines(); next() != ']'; skip_empty_lines()) {
      if (next() == '[') return fail("an array within an array is not supported", ErrorCode::unsupported);
      if (!read_value(values)) return false;
      skip_empty_lines();
      if (next() == ',')
        take();
      else if (next() != ']')
        return fail("\",\" or \"]\" is expected in the array");
    }
    take();
    return true;
  }

  bool read_value(std::vector<std::string>& values) {
    if (next() == '"' || next() == '\'') return read_string(values);
    auto word = take_while(is_of_bare_value);
    if (word == "true" || word == "false") {
      values.push_back(std::move(word));
      return true;
    }
    if (!is_number(word)) return fail("a value is expected: \"text\" in quotes, a number, true or false");
    word.erase(std::remove(word.begin(), word.end(), '_'), word.end());
    values.push_back(std::move(word));
    return true;
  }

  bool read_string(std::vector<std::string>& values) {
    const char quote = take();
    if (text_.substr(0, 2) == std::string(2, quote))
      return fail("strings over several lines are not supported", ErrorCode::unsupported);
    std::string value;
    while (next() != quote) {
      const auto c = static_cast<unsigned char>(next());
      if (at_end() || c == '\n') return fail("the text has no closing quote");
      if ((c < 0x20 && c != '\t') || c == 0x7F) return fail("a control character in a text");
      if (c == '\\' && quote == '"') {
        take();
        if (!read_escape(value)) return false;
      } else {
        value.push_back(take());
      }
    }
    take();
    values.push_back(std::move(value));
    return true;
  }

  bool read_escape(std::string& value) {
    switch (next()) {
      case '"':
      case '\\':
        value.push_back(take());
        return true;
      case 't':
        value.push_back('\t');
        break;
      case 'n':
        value.push_back('\n');
        break;
      default:
        return fail("an escape that is not one of \\\" \\\\ \\t \\n");
    }
    take();
    return true;
  }

  std::string_view text_;
  unsigned line_ = 1;
  std::optional<Error> error_;
};

}  // namespace

Result<std::vector<ConfigEntry>> parse_config(std::string_view text) { return ConfigReader(text).read(); }

}  // namespace semblante

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/speech/characters.h"
#include "core/speech/marked_ssml.h"
#include "core/speech/text_breaks.h"
#include "core/speech/xml_tag.h"
#include "core/types/printable.h"

namespace semblante {
namespace {

constexpr std::string_view xml_spaces = " \t\r\n";

/// Elements that mean the same in two halves.
bool can_be_halved(std::string_view name) {
  constexpr std::array<std::string_view, 4> names = {"speak", "p", "prosody", "emotion"};
  return std::find(names.begin(), names.end(), name) != names.end();
}
/// Elements whose halves are said as the whole if it is long: no date or word has hundreds of characters.
bool can_be_halved_if_long(std::string_view name) {
  constexpr std::array<std::string_view, 5> names = {"s", "say-as", "emphasis", "voice", "lang"};
  return can_be_halved(name) || std::find(names.begin(), names.end(), name) != names.end();
}
bool is_xml_space(char c) { return xml_spaces.find(c) != std::string_view::npos; }

/// Reads up to a place where the document can be cut.
class Cutter {
 public:
  explicit Cutter(std::string_view text) : text_(text) {}

  TextParts cut() {
    TextParts whole{std::string(text_), {}};
    while (at_ < text_.size() && !(may_end_here() && !belongs_to_what_was_said()))
      if (!step()) return whole;
    if (!says_something_after()) return whole;
    TextParts parts{std::string(text_.substr(0, at_)), {}};
    for (const Open& open : open_) parts.rest += open.source;
    parts.rest += text_.substr(at_);
    for (auto open = open_.rbegin(); open != open_.rend(); ++open)
      parts.first.append("</").append(open->name).append(">");
    while (at_ < text_.size())
      if (!step()) return whole;
    return open_.empty() ? parts : whole;
  }

 private:
  struct Open {
    std::string_view name;
    std::string_view source;  ///< its tag as it is written
  };

  [[nodiscard]] bool may_end_here() const {
    if (letters_ < least_part_letters) return false;
    if (ended_ && all_open(can_be_halved)) return true;
    return may_break(text_.substr(0, at_), text_.substr(at_), letters_) &&
           all_open(letters_ < long_part_letters ? can_be_halved : can_be_halved_if_long);
  }
  [[nodiscard]] bool all_open(bool (*may_be_cut)(std::string_view)) const {
    return std::all_of(open_.begin(), open_.end(), [&](const Open& open) { return may_be_cut(open.name); });
  }
  /// Spaces, signs and ends of elements go with the sentence before them.
  [[nodiscard]] bool belongs_to_what_was_said() const {
    const std::string_view rest = text_.substr(at_);
    return is_xml_space(rest[0]) || sentence_sign(rest) > 0 || rest.starts_with("</") || rest.starts_with("<!--");
  }
  /// Between tags and spaces.
  [[nodiscard]] bool says_something_after() const {
    bool in_tag = false;
    for (const char c : text_.substr(std::min(at_, text_.size()))) {
      if (!in_tag && c != '<' && !is_xml_space(c)) return true;
      in_tag = c == '<' || (in_tag && c != '>');
    }
    return false;
  }

  /// False: what is here is not understood, so that no cut is safe.
  bool step() {
    const std::string_view rest = text_.substr(at_);
    if (rest.starts_with("<!--")) {
      const std::size_t end = rest.find("-->");
      if (end == std::string_view::npos) return false;
      at_ += end + 3;
      return true;
    }
    if (rest.starts_with('<')) return take_tag(rest);
    const std::size_t next = xml_character_bytes(rest);
    // A line's end is a space here.
    if (const std::size_t sign = is_xml_space(rest[0]) ? 0 : sentence_sign(rest))
      ended_ = ended_ || ends_sentence(rest, sign);
    else if (!is_xml_space(rest[0]))
      ended_ = false;
    letters_ += letters_of_character(rest);
    at_ += next;
    return true;
  }

  bool take_tag(std::string_view rest) {
    const auto tag = read_xml_tag(rest);
    if (!tag) return false;
    if (tag->closes) {
      if (open_.empty() || open_.back().name != tag->name) return false;
      open_.pop_back();
      ended_ = ended_ || tag->name == "s" || tag->name == "p";
    } else if (!tag->is_empty) {
      open_.push_back({tag->name, rest.substr(0, tag->bytes)});
    }
    at_ += tag->bytes;
    return true;
  }

  std::string_view text_;
  std::size_t at_ = 0, letters_ = 0;
  bool ended_ = false;  ///< a sentence has ended, and nothing was said since
  std::vector<Open> open_;
};

}  // namespace

TextParts first_part_of_ssml(std::string_view text) {
  if (utf8_end(text) != text.size()) return {std::string(text), {}};
  return Cutter(text).cut();
}

}  // namespace semblante

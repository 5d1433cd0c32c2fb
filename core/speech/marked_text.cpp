#include "core/speech/marked_text.h"

#include <algorithm>
#include <array>
#include <optional>

#include "core/speech/text_breaks.h"
#include "core/speech/xml_tag.h"
#include "core/tables/mpeg4.h"
#include "core/types/printable.h"

namespace semblante {
namespace {

constexpr std::string_view no_emotion = "neutral";
/// Numbers of mpeg4::expressions.
enum : std::uint8_t { joy = 1, sadness, anger, fear, disgust, surprise };

struct Smiley {
  std::string_view text;
  std::uint8_t expression;
  double intensity;
};
/// A longer one comes before its beginning. The names of the emoji are those of Unicode's emoji-test.txt.
constexpr auto smileys = std::to_array<Smiley>({
    {":-)", joy, 0.7},      {":)", joy, 0.7},       {"=)", joy, 0.7},       {":-D", joy, 1.0},
    {":D", joy, 1.0},       {"xD", joy, 1.0},       {"XD", joy, 1.0},       {";-)", joy, 0.5},
    {";)", joy, 0.5},       {":-(", sadness, 0.8},  {":(", sadness, 0.8},   {"=(", sadness, 0.8},
    {":'(", sadness, 1.0},  {">:(", anger, 0.9},    {">:-(", anger, 0.9},   {":-O", surprise, 0.9},
    {":O", surprise, 0.9},  {":-o", surprise, 0.7}, {":o", surprise, 0.7},  {"D:", fear, 0.9},
    {"😀", joy, 0.8},        {"😃", joy, 0.9},        {"😄", joy, 1.0},        {"😁", joy, 1.0},
    {"😆", joy, 1.0},        {"😂", joy, 1.0},        {"🤣", joy, 1.0},     {"🙂", joy, 0.5},
    {"😊", joy, 0.7},        {"😉", joy, 0.5},        {"😍", joy, 0.9},        {"🥳", joy, 1.0},
    {"😢", sadness, 0.8},    {"😭", sadness, 1.0},    {"😞", sadness, 0.7},    {"😔", sadness, 0.6},
    {"🙁", sadness, 0.5}, {"☹", sadness, 0.7},    {"😠", anger, 0.8},      {"😡", anger, 1.0},
    {"🤬", anger, 1.0},   {"😤", anger, 0.7},      {"😨", fear, 0.8},       {"😰", fear, 0.7},
    {"😱", fear, 1.0},       {"🤢", disgust, 0.8}, {"🤮", disgust, 1.0}, {"😖", disgust, 0.5},
    {"😮", surprise, 0.7},   {"😲", surprise, 1.0},   {"😯", surprise, 0.6},   {"🤯", surprise, 1.0},
});
/// Asks for the coloured picture of the sign before it.
constexpr std::string_view picture_selector = "\xEF\xB8\x8F";

constexpr std::array<Prosody, mpeg4::expressions.size()> prosodies = {
    {{1.0, 1.0}, {1.05, 1.12}, {0.88, 0.9}, {1.06, 0.95}, {1.1, 1.12}, {0.94, 0.94}, {1.03, 1.12}}};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }

/// "[joy 0.5]" or "[/joy]" at the beginning of a text.
struct Tag {
  std::uint8_t expression = 0;
  bool closes = false;
  std::string_view intensity;  ///< as written; empty: none
  std::size_t bytes = 0;
};

std::optional<Tag> tag_at(std::string_view text) {
  const std::size_t end = text.find(']');
  if (!text.starts_with('[') || end == std::string_view::npos || end > 40) return std::nullopt;
  std::string_view inside = text.substr(1, end - 1);
  Tag tag;
  tag.bytes = end + 1;
  tag.closes = inside.starts_with('/');
  if (tag.closes) inside.remove_prefix(1);
  const std::size_t space = inside.find(' ');
  const int expression = expression_of(inside.substr(0, space));
  if (expression < 1) return std::nullopt;
  tag.expression = static_cast<std::uint8_t>(expression);
  if (space != std::string_view::npos) tag.intensity = inside.substr(space + 1);
  return tag;
}

bool is_emotion_tag(std::string_view text) {
  constexpr std::string_view begin = "<emotion", end = "</emotion";
  const std::string_view tag = text.starts_with(begin) ? begin : end;
  return text.starts_with(tag) && !(text.size() > tag.size() && is_letter(text[tag.size()]));
}

/// Bytes on both sides of a mark could make a character together, and be counted as two.
std::optional<Error> not_utf8(std::string_view text) {
  const std::size_t end = utf8_end(text);
  if (end == text.size()) return std::nullopt;
  return Error{ErrorCode::malformed, "text", "is not UTF-8 (byte " + std::to_string(end) + ")"};
}

class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  Result<MarkedText> read() {
    while (at_ < text_.size())
      if (auto fault = step()) return *std::move(fault);
    if (!open_.empty()) return Error{ErrorCode::malformed, "text", open_.back().tag + " is not closed"};
    // A smiley is about its sentence to the end, whether or not it stands there.
    for (const Pending& pending : pending_) end_at(pending, sentence_end(pending.sentence));
    // Where nothing is said, as of "😀", the emotions are of the face alone.
    if (!says_nothing(marked_.text))
      std::erase_if(marked_.emotions, [](const EmotionSpan& span) { return span.range.count == 0; });
    return std::move(marked_);
  }

  Result<TextParts> split() {
    while (at_ < text_.size() && !(may_end_here() && !belongs_to_what_was_said()))
      if (auto fault = step()) return *std::move(fault);
    TextParts parts{std::string(text_.substr(0, at_)), {}};
    const std::string_view rest = text_.substr(at_);
    if (says_nothing(rest)) return TextParts{std::string(text_), {}};
    for (const Open& open : open_) parts.rest += open.source;
    parts.rest += rest;
    for (auto open = open_.rbegin(); open != open_.rend(); ++open) parts.first += open->closing;
    return parts;
  }

 private:
  /// Whether the first part is long enough, and something ends here.
  [[nodiscard]] bool may_end_here() const {
    if (letters_ < least_part_letters) return false;
    if (!said_since_end_) return !ends_.empty();
    return may_break(text_.substr(0, at_), text_.substr(at_), letters_);
  }
  /// Spaces, signs, smileys and ends of spans go with the sentence before them.
  [[nodiscard]] bool belongs_to_what_was_said() const {
    const std::string_view rest = text_.substr(at_);
    const auto tag = tag_at(rest);
    return is_space(rest[0]) || sentence_sign(rest) > 0 || (tag && tag->closes) || rest.starts_with("</emotion") ||
           smiley_here() != nullptr;
  }

  std::optional<Error> step() {
    const std::string_view rest = text_.substr(at_);
    if (const auto tag = tag_at(rest)) return take(*tag);
    if (is_emotion_tag(rest)) return take_xml(rest);
    if (const Smiley* const smiley = smiley_here())
      take(*smiley);
    else
      take_character();
    return std::nullopt;
  }

  struct Pending {
    std::size_t emotion, sentence;
  };

  /// A span that is not closed yet.
  struct Open {
    std::string tag;          ///< as errors name it
    std::string closing;      ///< its end
    std::string_view source;  ///< as it is written
    std::size_t emotion;      ///< its index
  };

  [[nodiscard]] Error fail(const std::string& message) const {
    return {ErrorCode::malformed, "text", message + " (byte " + std::to_string(at_) + ")"};
  }

  /// `tag`: of the beginning.
  std::optional<Error> close(const std::string& tag, const std::string& closing) {
    if (open_.empty() || open_.back().tag != tag) return fail(closing + " closes what is not open");
    EmotionSpan& span = marked_.emotions[open_.back().emotion];
    span.range.count = characters_ - span.range.first;
    open_.pop_back();
    return std::nullopt;
  }
  /// `bytes`: of the tag as it is written.
  std::optional<Error> open(std::string tag, std::string closing, std::size_t bytes, std::uint8_t expression,
                            double intensity) {
    if (open_.size() == max_nested_spans) return fail("spans nest deeper than " + std::to_string(max_nested_spans));
    open_.push_back({std::move(tag), std::move(closing), text_.substr(at_, bytes), marked_.emotions.size()});
    marked_.emotions.push_back({expression, intensity, {characters_, 0}});
    return std::nullopt;
  }

  std::optional<Error> take(const Tag& tag) {
    const std::string name(mpeg4::expressions[tag.expression].name);
    if (tag.closes) {
      if (auto fault = close("[" + name + "]", "[/" + name + "]")) return fault;
    } else {
      const auto intensity = tag.intensity.empty() ? 1.0 : read_intensity(tag.intensity);
      if (!intensity) return fail("the intensity of [" + name + "] must be 0 to 1");
      if (auto fault = open("[" + name + "]", "[/" + name + "]", tag.bytes, tag.expression, *intensity)) return fault;
    }
    at_ += tag.bytes;
    return std::nullopt;
  }

  std::optional<Error> take_xml(std::string_view rest) {
    const std::string name = "<emotion>";
    const auto tag = read_xml_tag(rest);
    if (!tag) return fail(tag.error().message);
    if (tag->closes) {
      if (auto fault = close(name, "</emotion>")) return fault;
    } else {
      const auto emotion = emotion_of(*tag, "name");
      if (!emotion) return fail(emotion.error().message);
      if (tag->is_empty || tag->attributes.size() != (tag->attribute("intensity") ? 2U : 1U))
        return fail(name + " has only a name and an intensity, and a text in it");
      if (auto fault = open(name, "</emotion>", tag->bytes, emotion->expression, emotion->intensity)) return fault;
    }
    at_ += tag->bytes;
    return std::nullopt;
  }

  /// One of letters stands apart from words: "D:" is none in "ABCD:".
  [[nodiscard]] const Smiley* smiley_here() const {
    const std::string_view rest = text_.substr(at_);
    for (const Smiley& smiley : smileys) {
      if (!rest.starts_with(smiley.text)) continue;
      const bool is_emoji = static_cast<unsigned char>(smiley.text[0]) >= 0x80;
      const bool apart_before = at_ == 0 || !is_letter(text_[at_ - 1]);
      const std::size_t after = smiley.text.size();
      const bool apart_after = after >= rest.size() || !is_letter(rest[after]);
      if (is_emoji || (apart_before && apart_after)) return &smiley;
    }
    return nullptr;
  }

  void take(const Smiley& smiley) {
    at_ += smiley.text.size();
    if (text_.substr(at_).starts_with(picture_selector)) at_ += picture_selector.size();
    // After the end of a sentence it is about that one, unless there was none.
    const std::size_t about = said_since_end_ || ends_.empty() ? sentence_ : previous_sentence_;
    pending_.push_back({marked_.emotions.size(), about});
    marked_.emotions.push_back({smiley.expression, smiley.intensity, {about, 0}});
  }

  void take_character() {
    const std::string_view rest = text_.substr(at_);
    const std::size_t length = utf8_step(rest), sign = sentence_sign(rest);
    marked_.text.append(rest.substr(0, length));
    at_ += length;
    if (!is_space(rest[0]) && sign == 0) {
      if (!said_since_end_) {
        previous_sentence_ = ends_.empty() ? characters_ : sentence_;
        sentence_ = characters_;
      }
      said_since_end_ = true;
    }
    ++characters_;
    letters_ += letters_of_character(rest);
    if (sign > 0 && said_since_end_ && ends_sentence(rest, sign)) {
      ends_.push_back(characters_);
      said_since_end_ = false;
      previous_sentence_ = sentence_;
    }
  }

  [[nodiscard]] std::size_t sentence_end(std::size_t first) const {
    const auto end = std::upper_bound(ends_.begin(), ends_.end(), first);
    return end == ends_.end() ? characters_ : *end;
  }
  void end_at(const Pending& pending, std::size_t end) {
    TextRange& range = marked_.emotions[pending.emotion].range;
    range.count = end > range.first ? end - range.first : 0;
  }

  std::string_view text_;
  std::size_t at_ = 0;                                ///< bytes of what is read
  std::size_t characters_ = 0, letters_ = 0;          ///< of what is kept
  std::size_t sentence_ = 0, previous_sentence_ = 0;  ///< their first characters
  bool said_since_end_ = false;
  std::vector<std::size_t> ends_;  ///< of sentences, one past the last character
  std::vector<Open> open_;         ///< emotions whose end is to come
  std::vector<Pending> pending_;
  MarkedText marked_;
};

}  // namespace

int expression_of(std::string_view name) {
  if (name == no_emotion) return 0;
  const auto& all = mpeg4::expressions;
  const auto* const at = std::find_if(all.begin(), all.end(), [name](const auto& one) { return one.name == name; });
  return at == all.end() ? -1 : static_cast<int>(at - all.begin());
}

std::vector<std::string> emotion_names() {
  std::vector<std::string> names = {std::string(no_emotion)};
  for (std::size_t i = 1; i < mpeg4::expressions.size(); ++i) names.emplace_back(mpeg4::expressions[i].name);
  return names;
}

bool says_nothing(std::string_view text) { return std::all_of(text.begin(), text.end(), is_space); }

Result<MarkedText> read_marked_text(std::string_view text) {
  if (auto fault = not_utf8(text)) return *std::move(fault);
  return Reader(text).read();
}

Result<TextParts> first_part(std::string_view text) {
  if (auto fault = not_utf8(text)) return *std::move(fault);
  return Reader(text).split();
}

Prosody prosody_of(const NamedEmotion& emotion) {
  const Prosody& whole = prosodies[emotion.expression];
  return {1.0 + emotion.intensity * (whole.rate - 1.0), 1.0 + emotion.intensity * (whole.pitch - 1.0)};
}

Prosody prosody_of(const MarkedText& text) {
  std::size_t characters = 0;
  for (std::size_t at = 0; at < text.text.size(); ++characters) at += utf8_step(std::string_view(text.text).substr(at));
  Prosody mean;
  if (characters == 0) return mean;
  for (const EmotionSpan& span : text.emotions) {
    const double share =
        span.intensity * static_cast<double>(std::min(span.range.count, characters)) / static_cast<double>(characters);
    mean.rate += share * (prosodies[span.expression].rate - 1.0);
    mean.pitch += share * (prosodies[span.expression].pitch - 1.0);
  }
  mean.rate = std::clamp(mean.rate, 0.8, 1.25);
  mean.pitch = std::clamp(mean.pitch, 0.8, 1.25);
  return mean;
}

}  // namespace semblante

#include "core/speech/marked_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

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
bool is_space(char c) { return c == ' ' || c == '\n' || c == '\t'; }
bool ends_sentence(char c) { return c == '.' || c == '!' || c == '?' || c == '\n'; }

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

class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  Result<MarkedText> read() {
    while (at_ < text_.size()) {
      if (const auto tag = tag_at(text_.substr(at_))) {
        if (auto fault = take(*tag)) return *std::move(fault);
      } else if (const Smiley* const smiley = smiley_here()) {
        take(*smiley);
      } else {
        take_character();
      }
    }
    if (!open_.empty())
      return Error{
          ErrorCode::malformed, "text",
          "[" + std::string(mpeg4::expressions[marked_.emotions[open_.back()].expression].name) + "] is not closed"};
    // A smiley is about its sentence to the end, whether or not it stands there.
    for (const Pending& pending : pending_) end_at(pending, sentence_end(pending.sentence));
    std::erase_if(marked_.emotions, [](const EmotionSpan& span) { return span.range.count == 0; });
    return std::move(marked_);
  }

 private:
  struct Pending {
    std::size_t emotion, sentence;
  };

  std::optional<Error> take(const Tag& tag) {
    const auto fail = [this](std::string message) {
      return Error{ErrorCode::malformed, "text", std::move(message) + " (byte " + std::to_string(at_) + ")"};
    };
    const std::string name(mpeg4::expressions[tag.expression].name);
    if (tag.closes) {
      if (open_.empty() || marked_.emotions[open_.back()].expression != tag.expression)
        return fail("[/" + name + "] closes what is not open");
      EmotionSpan& span = marked_.emotions[open_.back()];
      span.range.count = characters_ - span.range.first;
      open_.pop_back();
    } else {
      double intensity = 1.0;
      if (!tag.intensity.empty()) {
        const char* const end = tag.intensity.data() + tag.intensity.size();
        const auto read = std::from_chars(tag.intensity.data(), end, intensity);
        if (read.ec != std::errc() || read.ptr != end || !(intensity >= 0.0 && intensity <= 1.0))
          return fail("the intensity of [" + name + "] must be 0 to 1");
      }
      open_.push_back(marked_.emotions.size());
      marked_.emotions.push_back({tag.expression, intensity, {characters_, 0}});
    }
    at_ += tag.bytes;
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
    const char c = text_[at_];
    const std::size_t length = utf8_step(text_.substr(at_));
    marked_.text.append(text_.substr(at_, length));
    at_ += length;
    if (!is_space(c) && !ends_sentence(c)) {
      if (!said_since_end_) {
        previous_sentence_ = ends_.empty() ? characters_ : sentence_;
        sentence_ = characters_;
      }
      said_since_end_ = true;
    }
    ++characters_;
    if (ends_sentence(c) && said_since_end_ &&
        (at_ >= text_.size() || is_space(text_[at_]) || ends_sentence(text_[at_]) || text_[at_] == '[')) {
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
  std::size_t characters_ = 0;                        ///< of what is kept
  std::size_t sentence_ = 0, previous_sentence_ = 0;  ///< their first characters
  bool said_since_end_ = false;
  std::vector<std::size_t> ends_;  ///< of sentences, one past the last character
  std::vector<std::size_t> open_;  ///< emotions whose end is to come
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

Result<MarkedText> read_marked_text(std::string_view text) { return Reader(text).read(); }

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

#include "core/speech/marked_ssml.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/speech/xml_tag.h"
#include "core/types/printable.h"

namespace semblante {
namespace {

constexpr std::string_view emotion_tag = "emotion", prosody_tag = "prosody";

class SsmlReader {
 public:
  explicit SsmlReader(std::string_view text) : text_(text) {}

  Result<MarkedSsml> read() {
    // Bytes on both sides of a tag could make a character together.
    if (at_ = utf8_end(text_); at_ != text_.size()) return fail("is not UTF-8");
    at_ = 0;
    while (at_ < text_.size()) {
      const std::string_view rest = text_.substr(at_);
      if (rest.starts_with("<!--")) {
        const std::size_t end = rest.find("-->");
        if (end == std::string_view::npos) return fail("a comment has no end");
        keep(rest.substr(0, end + 3));
      } else if (rest.starts_with('<')) {
        const auto tag = read_xml_tag(rest);
        if (!tag) return fail(tag.error().message);
        if (auto fault = take(*tag)) return *std::move(fault);
      } else if (rest.starts_with('&')) {
        take_reference(rest);
      } else {
        take_character(rest.substr(0, utf8_step(rest)), rest.substr(0, utf8_step(rest)));
      }
    }
    if (!open_.empty()) return fail("<" + std::string(open_.back().name) + "> is not closed");
    made_.places.push_back(said_);
    std::erase_if(made_.said.emotions, [](const EmotionSpan& span) { return span.range.count == 0; });
    return std::move(made_);
  }

 private:
  struct Open {
    std::string_view name;
    std::optional<std::size_t> emotion;  ///< its index
  };

  [[nodiscard]] Error fail(const std::string& message) const {
    return {ErrorCode::malformed, "text", message + " (byte " + std::to_string(at_) + ")"};
  }

  /// Adds to the document what is not said.
  void add(std::string_view piece) {
    for (std::size_t i = 0; i < piece.size(); i += utf8_step(piece.substr(i))) made_.places.push_back(said_);
    made_.document += piece;
  }
  void keep(std::string_view piece) {
    add(piece);
    at_ += piece.size();
  }
  /// A character of the source, and what it says.
  void take_character(std::string_view source, std::string_view says) {
    add(source);
    at_ += source.size();
    made_.said.text += says;
    ++said_;
  }

  /// A reference to one of XML's five entities says its character; the '&' of anything else says itself.
  void take_reference(std::string_view rest) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 5> known = {
        {{"&amp;", "&"}, {"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&apos;", "'"}}};
    for (const auto& [reference, says] : known)
      if (rest.starts_with(reference)) return take_character(reference, says);
    take_character(rest.substr(0, 1), rest.substr(0, 1));
  }

  std::optional<Error> take(const XmlTag& tag) {
    const std::string_view source = text_.substr(at_, tag.bytes);
    if (tag.name != emotion_tag && tag.name != prosody_tag) {
      keep(source);
      return std::nullopt;
    }
    if (tag.closes) {
      if (open_.empty() || open_.back().name != tag.name)
        return fail("</" + std::string(tag.name) + "> closes what is not open");
      if (open_.back().emotion) {
        EmotionSpan& span = made_.said.emotions[*open_.back().emotion];
        span.range.count = said_ - span.range.first;
      }
      open_.pop_back();
      add("</prosody>");
      at_ += tag.bytes;
      return std::nullopt;
    }
    if (tag.is_empty) return fail("<" + std::string(tag.name) + "/> has nothing in it");
    Open opened{tag.name, std::nullopt};
    std::string written = "<prosody";
    const bool is_emotion = tag.name == emotion_tag;
    if (is_emotion || tag.attribute("emotion")) {
      const auto emotion = emotion_of(tag, is_emotion ? "name" : "emotion");
      if (!emotion) return fail(emotion.error().message);
      opened.emotion = made_.said.emotions.size();
      made_.said.emotions.push_back({emotion->expression, emotion->intensity, {said_, 0}});
      if (is_emotion) {
        const Prosody prosody = prosody_of(*emotion);
        written += " rate=\"" + std::to_string(std::lround(100.0 * prosody.rate)) + "%\" pitch=\"" +
                   (prosody.pitch < 1.0 ? "" : "+") + std::to_string(std::lround(100.0 * (prosody.pitch - 1.0))) +
                   "%\"";
      }
    }
    for (const auto& [name, value] : tag.attributes) {
      if (name == "intensity" || name == (is_emotion ? "name" : "emotion")) continue;
      if (is_emotion) return fail("<emotion> has only a name and an intensity");
      const char* const quote = value.find('"') == std::string_view::npos ? "\"" : "'";
      written.append(" ").append(name).append("=").append(quote).append(value).append(quote);
    }
    open_.push_back(opened);
    add(written + ">");
    at_ += tag.bytes;
    return std::nullopt;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t said_ = 0;  ///< characters
  MarkedSsml made_;
  std::vector<Open> open_;
};

}  // namespace

Result<MarkedSsml> read_marked_ssml(std::string_view text) { return SsmlReader(text).read(); }

void place_in_text(const MarkedSsml& ssml, Utterance& utterance) {
  const auto place = [&ssml](std::size_t character) {
    return ssml.places[std::min(character, ssml.places.size() - 1)];
  };
  for (SpokenWord& word : utterance.words) {
    const std::size_t first = place(word.range.first);
    word.range = {first, place(word.range.first + word.range.count) - first};
  }
  for (SpokenSentence& sentence : utterance.sentences) sentence.first = place(sentence.first);
}

}  // namespace semblante

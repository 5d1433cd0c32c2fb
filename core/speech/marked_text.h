#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/speech/utterance.h"
#include "core/types/result.h"

namespace semblante {

/// An expression over a part of a text. 1..6: joy sadness anger fear disgust surprise.
struct EmotionSpan {
  std::uint8_t expression = 0;
  double intensity = 1.0;  ///< 0..1
  TextRange range;         ///< characters of the text to say
};

/// A text to say, and the expressions that its marks stand for.
struct MarkedText {
  std::string text;  ///< without marks
  std::vector<EmotionSpan> emotions;
};

/// 1..6 of "joy" and so on; 0 of "neutral" and "none"; -1 of anything else.
int expression_of(std::string_view name);
/// "neutral", then the expressions in the order of their numbers.
std::vector<std::string> emotion_names();

inline constexpr std::size_t max_nested_spans = 16;

/// Takes the marks out of a text: spans "[joy]...[/joy]", with an intensity "[joy 0.5]...[/joy]", or
/// <emotion name="joy" intensity="0.5">...</emotion>, which nest up to `max_nested_spans`
/// deep; emoticons (":)", ":-(") and emoji. A smiley colours the sentence that it stands in, or ends; before the first
/// word, the first one. Brackets with other words in them are text. Errors name the byte: a span that is not closed, or
/// closed and not open, or too deep; an intensity that is not 0 to 1; what is not UTF-8. Of a text without words the
/// emotions have no range, and are kept.
Result<MarkedText> read_marked_text(std::string_view text);

/// Whether a text without its marks has nothing to say: spaces alone.
bool says_nothing(std::string_view text);

/// A text in two, both with their marks; spans that go on are closed in the first and opened again in the rest.
struct TextParts {
  std::string first;
  std::string rest;  ///< empty: the text was short
};
/// Cuts a text after its first sentences of at least `least_part_letters`, or where a long one may break
/// (text_breaks.h), so that the first part can be heard while the rest is made. Errors as those of read_marked_text(),
/// of the first part.
Result<TextParts> first_part(std::string_view text);

/// How an expression changes the voice: factors of rate and pitch at full intensity; 1 for none.
struct Prosody {
  double rate = 1.0, pitch = 1.0;
};
struct NamedEmotion;
Prosody prosody_of(const NamedEmotion& emotion);
/// The mean over the characters of a text.
Prosody prosody_of(const MarkedText& text);

}  // namespace semblante

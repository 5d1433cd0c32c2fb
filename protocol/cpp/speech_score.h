#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/types/result.h"
#include "protocol/cpp/messages.h"

namespace semblante {

/// ms: a duration in a score is a multiple of it, at most eight times.
inline constexpr std::uint32_t score_unit = 30, longest_score_step = 8 * score_unit;

/// What the mouth does while a text is said: section 2.2 of SPEC.md. Times in ms from the beginning of the first word.
struct SpeechScore {
  struct Step {
    std::uint32_t begin = 0, end = 0;
    std::uint8_t viseme = 0;  ///< 0..14
    bool begins_word = false;
    friend bool operator==(const Step&, const Step&) = default;
  };
  struct Expression {
    std::uint32_t begin = 0;
    std::uint8_t expression = 0;  ///< 0 (none) to 6
    std::uint8_t intensity = 0;   ///< 0..63
    friend bool operator==(const Expression&, const Expression&) = default;
  };
  std::vector<Step> steps;              ///< without gaps
  std::vector<Expression> expressions;  ///< each until the next one

  [[nodiscard]] std::uint32_t duration() const { return steps.empty() ? 0 : steps.back().end; }
  friend bool operator==(const SpeechScore&, const SpeechScore&) = default;
};

/// nullopt for bytes that are no score.
std::optional<SpeechScore> read_score(std::span<const std::uint8_t> bytes);
/// Durations are multiples of score_unit; longer steps become several.
std::vector<std::uint8_t> write_score(const SpeechScore& score);

/// Spaces, tabs and ends of lines.
inline bool separates_words(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
/// Where the words of a text begin, in bytes: what is between them.
inline std::vector<std::size_t> word_begins(std::string_view text) {
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (!separates_words(text[i]) && (i == 0 || separates_words(text[i - 1]))) begins.push_back(i);
  return begins;
}

/// `malformed` at /score unless it is a score with as many words as the text.
Status check_text(const SpeechText& text);

}  // namespace semblante

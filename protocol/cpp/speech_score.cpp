#include "protocol/cpp/speech_score.h"

#include <algorithm>

namespace semblante {
namespace {

constexpr std::uint8_t expression_mark = 15, expressions = 7, intensities = 64;

}  // namespace

std::optional<SpeechScore> read_score(std::span<const std::uint8_t> bytes) {
  SpeechScore score;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const auto high = static_cast<std::uint8_t>(bytes[i] >> 4U);
    const auto low = static_cast<std::uint8_t>(bytes[i] & 15U);
    const std::uint32_t time = score.duration();
    if (high == expression_mark) {
      if (low >= expressions) return std::nullopt;
      std::uint8_t intensity = 0;
      if (low != 0) {
        if (++i == bytes.size() || bytes[i] >= intensities) return std::nullopt;
        intensity = bytes[i];
      }
      score.expressions.push_back({time, low, intensity});
      continue;
    }
    score.steps.push_back({time, time + ((low & 7U) + 1U) * score_unit, high, (low & 8U) != 0});
  }
  return score;
}

std::vector<std::uint8_t> write_score(const SpeechScore& score) {
  std::vector<std::uint8_t> bytes;
  auto expression = score.expressions.begin();
  const auto put_expressions = [&](std::uint32_t until) {
    for (; expression != score.expressions.end() && expression->begin <= until; ++expression) {
      bytes.push_back(static_cast<std::uint8_t>(expression_mark << 4U | expression->expression));
      if (expression->expression != 0) bytes.push_back(expression->intensity);
    }
  };
  for (const auto& step : score.steps) {
    bool begins = step.begins_word;
    for (std::uint32_t at = step.begin; at < step.end;) {
      put_expressions(at);
      std::uint32_t until = std::min(step.end, at + longest_score_step);
      if (expression != score.expressions.end()) until = std::min(until, expression->begin);
      const std::uint32_t units = (until - at) / score_unit;
      bytes.push_back(static_cast<std::uint8_t>(std::uint32_t{step.viseme} << 4U | (begins ? 8U : 0U) | (units - 1U)));
      begins = false;
      at = until;
    }
  }
  put_expressions(score.duration());
  return bytes;
}

Status check_text(const SpeechText& text) {
  const auto score = read_score(text.score);
  if (!score) return Error{ErrorCode::malformed, "/score", "is no score"};
  const auto words =
      std::count_if(score->steps.begin(), score->steps.end(), [](const auto& s) { return s.begins_word; });
  if (static_cast<std::size_t>(words) != word_begins(text.text).size())
    return Error{ErrorCode::malformed, "/score", "has not as many words as the text"};
  return Unit{};
}

}  // namespace semblante

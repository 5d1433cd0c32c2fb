#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/cpp/messages.h"
#include "protocol/cpp/speech_score.h"

/// The adaptive model of packed texts: SPEC.md, "Packed text". Integers only, so that every language has the same
/// probabilities.
namespace semblante::text_model {

inline constexpr std::size_t inputs = 6, sets = 3;
inline constexpr unsigned index_bits = 16;
inline constexpr std::uint16_t unused_slot = 2048U << 4U;
inline constexpr std::int32_t first_weight = 65536 / 3, most_weight = 1 << 20;
inline constexpr unsigned end_of_string = 255;  ///< a byte that UTF-8 does not have

/// What a model has learned.
struct Memory {
  /// By input and context: the probability of a 1 in 4096ths, and in the lowest four bits how often it was met.
  std::array<std::array<std::uint16_t, 1U << index_bits>, inputs> slots;
  /// By set of fields, input and how often the context was met, in 65536ths.
  std::array<std::array<std::array<std::int32_t, 16>, inputs>, sets> weights;

  Memory() {
    for (auto& input : slots) input.fill(unused_slot);
    for (auto& set : weights)
      for (auto& input : set) input.fill(first_weight);
  }
};

/// What a model has learned from the texts of text_prime.json, with which each packed text begins.
const Memory& primed();

/// Chance of a 1, 1..4095 in 4096ths, of a logit in 256ths.
inline int squash(int logit) {
  static constexpr std::array<int, 33> chances = {1,    2,    4,    6,    10,   17,   27,   45,   74,   120,  194,
                                                  311,  488,  747,  1102, 1546, 2048, 2550, 2994, 3349, 3608, 3785,
                                                  3902, 3976, 4022, 4051, 4069, 4079, 4086, 4090, 4092, 4094, 4095};
  logit = std::clamp(logit, -2047, 2047) + 2048;
  const int part = logit % 128;
  const auto at = static_cast<std::size_t>(logit / 128);
  return (chances[at] * (128 - part) + chances[at + 1] * part + 64) / 128;
}

/// The smallest logit with at least this chance.
inline const std::array<std::int16_t, 4096>& stretched() {
  static const auto table = [] {
    std::array<std::int16_t, 4096> logits{};
    int logit = -2047;
    for (int chance = 0; chance < 4096; ++chance) {
      while (logit < 2047 && squash(logit) < chance) ++logit;
      logits[static_cast<std::size_t>(chance)] = static_cast<std::int16_t>(logit);
    }
    return logits;
  }();
  return table;
}

constexpr std::uint32_t fold(std::uint32_t hash, std::uint32_t value) {
  hash = (hash + value + 1U) * 0x9E3779B1U;
  return hash ^ hash >> 15U;
}

[[gnu::noinline]] constexpr std::uint32_t hash_of(std::initializer_list<std::uint32_t> values) {
  std::uint32_t hash = 0;
  for (const std::uint32_t value : values) hash = fold(hash, value);
  return hash;
}

constexpr std::uint32_t lower(char c) {
  const auto byte = static_cast<std::uint8_t>(c);
  return byte >= 'A' && byte <= 'Z' ? byte + 32U : byte;
}

/// The visemes that a letter usually has, by bits.
constexpr unsigned usual_visemes(char c) {
  constexpr unsigned vowels = 0x7C00;  // 10 to 14
  switch (lower(c)) {
    case 'a':
    case 'e':
    case 'i':
    case 'o':
    case 'u':
    case 'y':
      return vowels;
    case 'b':
    case 'm':
    case 'p':
      return 1U << 1U;
    case 'f':
    case 'v':
      return 1U << 2U;
    case 't':
      return 1U << 3U | 1U << 4U | 1U << 6U;
    case 'd':
      return 1U << 4U | 1U << 6U;
    case 'g':
    case 'k':
    case 'q':
      return 1U << 5U | 1U << 6U;
    case 'c':
    case 'x':
      return 1U << 5U | 1U << 6U | 1U << 7U;
    case 'j':
      return 1U << 6U;
    case 's':
    case 'z':
      return 1U << 6U | 1U << 7U;
    case 'l':
      return 1U << 8U | 1U << 14U;
    case 'n':
      return 1U << 8U;
    case 'r':
    case 'h':
      return 1U << 5U | 1U << 9U;
    case 'w':
      return 1U << 14U;
    default:
      return static_cast<std::uint8_t>(c) >= 0xC0U ? vowels | 1U << 7U : 0U;
  }
}

/// Codes texts one after another; learns from each. Coder: RangeEncoder or RangeDecoder.
template <class Coder>
class TextModel {
 public:
  TextModel(Coder& coder, Memory& memory) : coder_(coder), memory_(memory) {}

  /// Codes language, text and score. When decoding, the pointer of what is no text; empty: none is wrong so far, and
  /// the coder tells whether its bytes ended early.
  std::string_view message(SpeechText& text) {
    portuguese_ = 0;
    if (!string(Field::language, text.language, 64)) return "/language";
    portuguese_ = text.language.starts_with("pt") ? 1 : 0;
    if (!string(Field::text, text.text, max_speech_text_bytes)) return "/text";
    if (!score(text)) return "/score";
    return {};
  }

 private:
  enum class Field : std::uint8_t { language, text, begins_word, viseme, duration, intensity };
  using Contexts = std::array<std::uint32_t, inputs>;

  static constexpr unsigned mark = 15;  ///< in place of a viseme

  [[gnu::noinline]] unsigned bit(const Contexts& contexts, unsigned node, unsigned value) {
    auto& set = memory_.weights[set_];
    std::array<std::uint16_t*, inputs> slots{};
    std::array<std::int32_t*, inputs> weights{};
    std::array<std::int32_t, inputs> logits{};
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < inputs; ++i) {
      slots[i] = &memory_.slots[i][fold(contexts[i], node) >> (32U - index_bits)];
      const unsigned met = *slots[i] & 15U;
      weights[i] = &set[i][met];
      logits[i] = met == 0 ? 0 : stretched()[*slots[i] >> 4U];
      sum += std::int64_t{logits[i]} * *weights[i];
    }
    const int chance = squash(static_cast<int>(std::clamp<std::int64_t>(sum >> 16, -2047, 2047)));
    value = static_cast<unsigned>(coder_.bit(static_cast<std::uint32_t>(chance), static_cast<int>(value)));
    const std::int32_t error = 6 * ((value != 0 ? 4096 : 0) - chance);
    for (std::size_t i = 0; i < inputs; ++i) {
      *weights[i] = std::clamp(*weights[i] + ((logits[i] * error + 8192) >> 14), -most_weight, most_weight);
      const unsigned met = *slots[i] & 15U;
      unsigned fine = (*slots[i] & 0xFFF0U) + 8U;
      fine = value != 0 ? fine + (65535U - fine) / (met + 2U) : fine - fine / (met + 2U);
      *slots[i] = static_cast<std::uint16_t>((fine & 0xFFF0U) | std::min(met + 1U, 14U));
    }
    return value;
  }

  /// Codes `count` bits, high bits first.
  [[gnu::noinline]] unsigned symbol(const Contexts& contexts, unsigned count, unsigned value) {
    unsigned node = 1;
    while (count-- > 0) node = 2 * node + bit(contexts, node, value >> count & 1U);
    return node;
  }

  [[nodiscard]] bool ended_early() const {
    if constexpr (Coder::decodes)
      return !coder_.valid() || coder_.truncated();
    else
      return false;
  }

  bool string(Field field, std::string& text, std::size_t most) {
    set_ = 0;
    const auto kind = static_cast<std::uint32_t>(field);
    std::uint32_t word = 0;
    for (std::size_t i = 0; !ended_early(); ++i) {
      const auto before = [&](std::size_t back) { return i >= back ? lower(text[i - back]) : 0U; };
      const std::uint32_t a = before(1), b = before(2), c = before(3), d = before(4);
      const Contexts contexts = {hash_of({kind}),
                                 hash_of({kind, portuguese_, a}),
                                 hash_of({kind, portuguese_, a, b}),
                                 hash_of({kind, portuguese_, a, b, c}),
                                 hash_of({kind, portuguese_, a, b, c, d}),
                                 hash_of({kind, portuguese_, a, word})};
      const unsigned given = i < text.size() && !Coder::decodes ? static_cast<std::uint8_t>(text[i]) : end_of_string;
      const unsigned byte = symbol(contexts, 8, given) - 256U;
      if (byte == end_of_string) return true;
      if constexpr (Coder::decodes) {
        if (i == most) return false;
        text.push_back(static_cast<char>(byte));
      }
      const std::uint32_t letter = lower(text[i]);
      word = letter >= 'A' || letter == '\'' ? fold(word, letter) : 0;
    }
    return true;
  }

  /// The word that is said, and the letter at which its sound has probably come.
  struct Place {
    std::size_t begin = 0, end = 0, at = 0;
    std::uint32_t hash = 0, steps = 0;
  };

  void enter(Place& place, const std::string& text, std::size_t begin) {
    const std::size_t end = std::min(text.find_first_of(" \t\n\r", begin), text.size());
    place = {begin, end, begin, 0, 0};
    for (std::size_t i = begin; i < end; ++i) place.hash = fold(place.hash, lower(text[i]));
  }

  bool score(SpeechText& text) {
    const auto words = word_begins(text.text);
    std::size_t word = 0;  // the next one
    Place place;
    std::uint32_t viseme = 0, older = 0, length = 0;
    for (std::size_t i = 0; !ended_early();) {
      const unsigned given = i < text.score.size() && !Coder::decodes ? text.score[i] : 0xFFU;
      const auto letter = [&](std::size_t ahead, std::size_t back = 0) -> std::uint32_t {
        const std::size_t at = place.at + ahead;
        if (at < place.begin + back) return 1;
        return at - back >= place.end ? 2 : lower(text.text[at - back]);
      };
      const auto rest = [&] { return static_cast<std::uint32_t>(std::min<std::size_t>(place.end - place.at, 3)); };
      const auto contexts = [&](Field field) -> Contexts {
        const auto kind = static_cast<std::uint32_t>(field);
        const std::uint32_t here = letter(0), next = letter(1), is_last = word == words.size() ? 1 : 0;
        return {hash_of({kind, portuguese_, here, next}),
                hash_of({kind, portuguese_, letter(0, 1), here, next, letter(2)}),
                hash_of({kind, viseme, older}),
                hash_of({kind, portuguese_, viseme, here}),
                hash_of({kind, portuguese_, place.hash, place.steps}),
                hash_of({kind, viseme, rest(), length, is_last})};
      };
      set_ = 1;
      const unsigned begins = bit(contexts(Field::begins_word), 1, given >> 3U & 1U);
      if (begins != 0 && word < words.size()) enter(place, text.text, words[word]);
      const unsigned now = symbol(contexts(Field::viseme), 4, given >> 4U) - 16U;
      if (begins != 0 && now == mark) return true;
      if (begins != 0 && word++ == words.size()) return false;

      set_ = 2;
      const auto kind = static_cast<std::uint32_t>(Field::duration);
      const unsigned low =
          symbol({hash_of({kind, now}), hash_of({kind, now, viseme}),
                  hash_of({kind, now, portuguese_, letter(0), letter(1)}), hash_of({kind, now, portuguese_, rest()}),
                  hash_of({kind, now, portuguese_, place.hash, place.steps}), hash_of({kind, now, length})},
                 3, given & 7U) -
          8U;
      if (!put(text.score, i, now << 4U | begins << 3U | low)) return false;
      if (now == mark) {
        if (low == 7) return false;
        if (low == 0) continue;
        Contexts alone{};
        alone.fill(hash_of({static_cast<std::uint32_t>(Field::intensity)}));
        const unsigned intensity = Coder::decodes ? 0U : text.score[i];
        if (!put(text.score, i, symbol(alone, 6, intensity) - 64U)) return false;
        continue;
      }
      for (std::size_t at = place.at; at < std::min(place.at + 3, place.end); ++at) {
        if ((usual_visemes(text.text[at]) >> now & 1U) == 0) continue;
        place.at = at + 1;
        while (place.at < place.end && (static_cast<std::uint8_t>(text.text[place.at]) & 0xC0U) == 0x80U) ++place.at;
        break;
      }
      older = viseme;
      viseme = now;
      length = low;
      ++place.steps;
    }
    return true;
  }

  bool put(std::vector<std::uint8_t>& score, std::size_t& at, unsigned byte) {
    if constexpr (Coder::decodes) {
      if (at == max_score_bytes) return false;
      score.push_back(static_cast<std::uint8_t>(byte));
    }
    ++at;
    return true;
  }

  Coder& coder_;
  Memory& memory_;
  std::size_t set_ = 0;
  std::uint32_t portuguese_ = 0;
};

}  // namespace semblante::text_model

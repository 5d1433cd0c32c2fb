#include "core/speech/cues.h"

#include <algorithm>
#include <array>

#include "core/speech/text_breaks.h"
#include "core/types/printable.h"

namespace semblante {
namespace {

constexpr std::size_t most_letters = 74;  ///< of a cue
/// A cue may end with a clause if it has this share of the mean length of the sentence's cues.
constexpr double least_clause_share = 0.6;

/// First and last characters that are as wide as two letters: Hangul, Han, kana, and the signs of their fullwidth
/// forms.
constexpr std::array<CharacterRange, 6> wide = {{
    {"\u1100", "\u115F"},
    {"\u2E80", "\uA4CF"},
    {"\uAC00", "\uD7A3"},
    {"\uF900", "\uFAFF"},
    {"\uFE30", "\uFE4F"},
    {"\uFF00", "\uFF60"},
}};

std::size_t width_of(std::string_view text) {
  std::size_t sum = 0;
  while (!text.empty()) {
    sum += begins_in(text, wide) ? 2 : 1;
    text.remove_prefix(utf8_step(text));
  }
  return sum;
}

std::string_view without_space_after(std::string_view text) {
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

/// The words of a sentence by the letters before them.
class Words {
 public:
  Words(std::string_view text, std::span<const std::size_t> begins, std::size_t end) {
    std::size_t width = 0;
    for (std::size_t i = 0; i < begins.size(); ++i) {
      const std::size_t stop = std::max(begins[i], i + 1 < begins.size() ? begins[i + 1] : end);
      const std::string_view all = text.substr(begins[i], stop - begins[i]), word = without_space_after(all);
      words_.push_back(word);
      begins_.push_back(width);
      ends_.push_back(width + width_of(word));
      width = ends_.back() + width_of(all.substr(word.size()));
    }
  }

  [[nodiscard]] std::size_t count() const { return words_.size(); }
  [[nodiscard]] std::string_view operator[](std::size_t i) const { return words_[i]; }
  /// Letters from a word to the one before `end`.
  [[nodiscard]] std::size_t width(std::size_t first, std::size_t end) const { return ends_[end - 1] - begins_[first]; }
  /// As few cues as hold the words from `first` on.
  [[nodiscard]] std::size_t cues_from(std::size_t first) const {
    std::size_t cues = 1, begin = first;
    for (std::size_t i = first; i < count(); ++i) {
      if (i == begin || width(begin, i + 1) <= most_letters) continue;
      ++cues;
      begin = i;
    }
    return cues;
  }

 private:
  std::vector<std::string_view> words_;
  std::vector<std::size_t> begins_, ends_;
};

}  // namespace

std::vector<std::size_t> cue_ends(std::string_view text, std::span<const std::size_t> begins, std::size_t end) {
  const Words words(text, begins, end);
  std::vector<std::size_t> ends;
  if (words.count() == 0) return ends;
  const std::size_t cues = words.cues_from(0);
  const double share = static_cast<double>(words.width(0, words.count())) / static_cast<double>(cues);
  std::size_t first = 0;
  for (std::size_t i = 1; i < words.count() && words.width(first, words.count()) > most_letters; ++i) {
    const auto has = static_cast<double>(words.width(first, i));
    const bool is_full = words.width(first, i + 1) > most_letters;
    const bool is_clause =
        has >= least_clause_share * share && ends_clause(words[i - 1]) && words.cues_from(i) < cues - ends.size();
    if (has < share && !is_clause && !is_full) continue;
    ends.push_back(i);
    first = i;
  }
  ends.push_back(words.count());
  return ends;
}

}  // namespace semblante

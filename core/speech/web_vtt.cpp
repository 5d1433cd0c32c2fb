#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>

#include "core/speech/characters.h"
#include "core/speech/speech.h"
#include "core/speech/text_breaks.h"

namespace semblante {
namespace {

constexpr std::size_t most_characters_a_cue = 74;  ///< two lines of 37, as subtitles have
constexpr double word_tail_ms = 800.0;             ///< how long the last word of a cue may stay, at most

std::string time_text(double ms) {
  const auto whole = static_cast<long long>(std::llround(std::max(0.0, ms)));
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%02lld:%02lld:%02lld.%03lld", whole / 3'600'000, whole / 60'000 % 60,
                whole / 1000 % 60, whole % 1000);
  return text.data();
}

/// Text as WebVTT has it: on one line, without markup, with one space in place of several.
std::string on_one_line(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (!is_space(c))
      safe += c;
    else if (!safe.ends_with(' '))
      safe += ' ';
  }
  return safe;
}

/// One past the last word of the sentence that the word `first` is in.
std::size_t end_of_sentence(const Utterance& utterance, std::size_t first) {
  const auto& words = utterance.words;
  const auto next = std::upper_bound(utterance.sentences.begin(), utterance.sentences.end(), words[first].time,
                                     [](double time, const SpokenSentence& s) { return time < s.time; });
  std::size_t end = first + 1;
  while (end < words.size() && (next == utterance.sentences.end() || words[end].time < next->time)) ++end;
  return end;
}

std::size_t characters_between(std::span<const SpokenWord> words, std::size_t first, std::size_t end) {
  const std::size_t begin = words[first].range.first, stop = words[end - 1].range.first + words[end - 1].range.count;
  return stop > begin ? stop - begin : 0;
}

/// One past the last word of the cue that begins with `first`: the rest of a sentence, which ends before `end`, in as
/// few cues as hold it, of about the same length.
std::size_t end_of_cue(std::span<const SpokenWord> words, std::size_t first, std::size_t end) {
  const auto full = [&](std::size_t from) {
    std::size_t last = from + 1;
    while (last < end && characters_between(words, from, last + 1) <= most_characters_a_cue) ++last;
    return last;
  };
  std::size_t cues = 1;
  for (std::size_t last = full(first); last < end; last = full(last)) ++cues;
  const std::size_t share = characters_between(words, first, end) / cues, most = full(first);
  std::size_t last = first + 1;
  while (last < most && characters_between(words, first, last) < share) ++last;
  return last;
}

}  // namespace

std::string web_vtt(const Utterance& utterance, std::string_view text) {
  const Characters characters(text);
  const auto& words = utterance.words;
  const auto begin_of = [&](std::size_t i) {
    return i == 0 ? 0 : i == words.size() ? text.size() : with_opening(text, characters.byte_of(words[i].range.first));
  };
  std::string vtt = "WEBVTT\n";
  std::size_t sentence_end = 0;
  for (std::size_t first = 0; first < words.size();) {
    if (first == sentence_end) sentence_end = end_of_sentence(utterance, first);
    const std::size_t last = end_of_cue(words, first, sentence_end);
    const bool is_end = last == words.size();
    const double end =
        std::min(is_end ? utterance.duration : words[last].time, words[last - 1].time + word_tail_ms + 200.0);
    if (end > words[first].time) {
      vtt += "\n" + time_text(words[first].time) + " --> " + time_text(end) + "\n";
      for (std::size_t i = first; i < last; ++i) {
        // The word with the signs and the space after it, up to the next word.
        const std::string part = on_one_line(text.substr(begin_of(i), begin_of(i + 1) - begin_of(i)));
        if (i > first && words[i].time > words[first].time && words[i].time < end)
          vtt += "<" + time_text(words[i].time) + ">";
        vtt += i == first ? part.substr(std::min(part.find_first_not_of(' '), part.size())) : part;
      }
      vtt.resize(vtt.find_last_not_of(' ') + 1);
      vtt += "\n";
    }
    first = last;
  }
  return vtt;
}

}  // namespace semblante

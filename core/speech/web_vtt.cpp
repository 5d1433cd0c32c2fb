#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/speech/characters.h"
#include "core/speech/speech.h"
#include "core/speech/text_breaks.h"

namespace semblante {
namespace {

constexpr std::size_t most_characters_a_cue = 70;
constexpr double word_tail_ms = 800.0;  ///< how long the last word of a cue may stay, at most

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

}  // namespace

std::string web_vtt(const Utterance& utterance, std::string_view text) {
  const Characters characters(text);
  const auto& words = utterance.words;
  const auto begin_of = [&](std::size_t i) {
    return i == 0 ? 0 : i == words.size() ? text.size() : with_opening(text, characters.byte_of(words[i].range.first));
  };
  std::string vtt = "WEBVTT\n";
  for (std::size_t first = 0; first < words.size();) {
    // To the end of the sentence, or where the line is full.
    const auto sentence = std::upper_bound(utterance.sentences.begin(), utterance.sentences.end(), words[first].time,
                                           [](double time, const SpokenSentence& s) { return time < s.time; });
    std::size_t last = first + 1;
    while (last < words.size() && (sentence == utterance.sentences.end() || words[last].time < sentence->time) &&
           words[last].range.first + words[last].range.count <= words[first].range.first + most_characters_a_cue)
      ++last;
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

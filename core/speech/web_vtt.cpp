#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/speech/characters.h"
#include "core/speech/cues.h"
#include "core/speech/speech.h"
#include "core/speech/text_breaks.h"

namespace semblante {
namespace {

constexpr double longest_last_word_ms = 1000.0;  ///< how long the last word of a cue stays, at most

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

}  // namespace

std::string web_vtt(const Utterance& utterance, std::string_view text) {
  const Characters characters(text);
  const auto& words = utterance.words;
  const auto begin_of = [&](std::size_t i) {
    return i == 0 ? 0 : i == words.size() ? text.size() : with_opening(text, characters.byte_of(words[i].range.first));
  };
  std::string vtt = "WEBVTT\n";
  const auto add_cue = [&](std::size_t first, std::size_t last) {
    const double next = last == words.size() ? utterance.duration : words[last].time;
    const double end = std::min(next, words[last - 1].time + longest_last_word_ms);
    if (end <= words[first].time) return;
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
  };
  for (std::size_t sentence = 0; sentence < words.size();) {
    const std::size_t sentence_end = end_of_sentence(utterance, sentence);
    std::vector<std::size_t> begins;
    for (std::size_t i = sentence; i < sentence_end; ++i) begins.push_back(begin_of(i));
    std::size_t first = 0;
    for (const std::size_t last : cue_ends(text, begins, begin_of(sentence_end))) {
      add_cue(sentence + first, sentence + last);
      first = last;
    }
    sentence = sentence_end;
  }
  return vtt;
}

}  // namespace semblante

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/speech/characters.h"
#include "core/speech/speech.h"

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

/// Text as WebVTT has it: on one line, without markup.
std::string plain(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else
      safe += c == '\n' || c == '\t' || c == '\r' ? ' ' : c;
  }
  const std::size_t first = safe.find_first_not_of(' ');
  if (first == std::string::npos) return {};
  return safe.substr(first, safe.find_last_not_of(' ') - first + 1);
}

}  // namespace

std::string web_vtt(const Utterance& utterance, std::string_view text) {
  const Characters characters(text);
  const auto& words = utterance.words;
  std::string vtt = "WEBVTT\n";
  for (std::size_t first = 0; first < words.size();) {
    // To the end of the sentence, or where the line is full.
    const auto sentence = std::upper_bound(utterance.sentences.begin(), utterance.sentences.end(), words[first].time,
                                           [](double time, const SpokenSentence& s) { return time < s.time; });
    std::size_t last = first + 1;
    while (last < words.size() && (sentence == utterance.sentences.end() || words[last].time < sentence->time) &&
           words[last].range.first + words[last].range.count <= words[first].range.first + most_characters_a_cue &&
           words[last].range.first >= words[last - 1].range.first)
      ++last;
    const bool is_end = last == words.size();
    const double end =
        std::min(is_end ? utterance.duration : words[last].time, words[last - 1].time + word_tail_ms + 200.0);
    if (end > words[first].time) {
      vtt += "\n" + time_text(words[first].time) + " --> " + time_text(end) + "\n";
      for (std::size_t i = first; i < last; ++i) {
        const std::size_t begin = characters.byte_of(words[i].range.first);
        const std::size_t own_end = characters.byte_of(words[i].range.first + words[i].range.count);
        // The word with the signs after it, up to the next word, also where that begins within this one: a number that
        // is said in parts ("3", ",5"). A voice's words have no such parts any more (whole_words.h).
        const bool is_last_in_cue = i + 1 == last;
        const bool is_very_last = i + 1 == words.size();
        std::size_t until = is_very_last ? text.size() : characters.byte_of(words[i + 1].range.first);
        if (until <= begin) until = own_end;
        const auto part = text.substr(begin, until - begin);
        const std::string word = plain(part);
        const bool is_apart = !part.empty() && plain(part.substr(part.size() - 1)).empty();
        if (i > first && words[i].time > words[first].time && words[i].time < end)
          vtt += "<" + time_text(words[i].time) + ">";
        vtt += word + (is_last_in_cue ? "\n" : is_apart ? " " : "");
      }
    }
    first = last;
  }
  return vtt;
}

}  // namespace semblante

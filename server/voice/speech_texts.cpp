#include "server/voice/speech_texts.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/speech/characters.h"
#include "core/speech/segments.h"
#include "protocol/cpp/speech_score.h"

namespace semblante::voice {
namespace {

/// Longer sentences are divided, at a word: they are said in one go by voices that some browsers stop after a quarter
/// of a minute.
constexpr std::size_t longest_part = 300;  ///< bytes
constexpr std::uint8_t closed_lips = 1;    ///< the viseme of p, b, m
/// Lips that are closed for less are not seen to close at 25 frames a second.
constexpr std::uint32_t least_closure = 2 * score_unit;

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// A word that was said: where it begins, in bytes of the text, and when.
struct Place {
  std::size_t byte = 0;
  double time = 0.0;
};

std::vector<Place> places_of(const Utterance& utterance, const Characters& characters) {
  std::vector<Place> places;
  for (const SpokenWord& word : utterance.words) {
    const std::size_t byte = characters.byte_of(word.range.first);
    // A voice may name a word twice, or one before it.
    if (places.empty() || byte > places.back().byte) places.push_back({byte, word.time});
  }
  return places;
}

bool ends_sentence(std::string_view text) {
  while (!text.empty() &&
         (is_space(text.back()) || std::string_view("\"')]").find(text.back()) != std::string_view::npos))
    text.remove_suffix(1);
  return !text.empty() && std::string_view(".!?").find(text.back()) != std::string_view::npos;
}

/// The places at which parts begin: sentences, and words within sentences that are too long.
std::vector<std::size_t> parts_of(const Speech& speech, const std::vector<Place>& places,
                                  const Characters& characters) {
  std::vector<std::size_t> sentences;
  for (const SpokenSentence& sentence : speech.utterance.sentences)
    sentences.push_back(characters.byte_of(sentence.first));
  const std::string_view text = speech.text;
  std::vector<std::size_t> parts;  // indices of places
  auto sentence = sentences.begin();
  for (std::size_t i = 0; i < places.size(); ++i) {
    bool begins = i == 0;
    for (; sentence != sentences.end() && *sentence <= places[i].byte; ++sentence) begins = true;
    if (i > 0 && sentences.empty())
      begins = ends_sentence(text.substr(places[i - 1].byte, places[i].byte - places[i - 1].byte));
    const std::size_t end = i + 1 < places.size() ? places[i + 1].byte : text.size();
    if (begins || end - places[parts.back()].byte > longest_part) parts.push_back(i);
  }
  return parts;
}

/// A word with the quotation mark or bracket before it.
std::size_t with_opening(std::string_view text, std::size_t byte) {
  while (byte > 0 && std::string_view("\"'([").find(text[byte - 1]) != std::string_view::npos) --byte;
  return byte;
}

std::uint8_t viseme_of(const Segment& segment) {
  return segment.sound.share >= 0.5F ? segment.sound.viseme : segment.sound.other;
}

/// What an expression cue has at a time: its value while it lasts.
std::pair<std::uint8_t, double> expression_at(const PerformanceScript& script, double ms) {
  std::pair<std::uint8_t, double> strongest{0, 0.0};
  for (const Cue& cue : script.cues) {
    const auto* target = std::get_if<ExpressionTarget>(&cue.target);
    if (target == nullptr || ms < cue.time || ms >= cue.time + cue.duration.value_or(0.0) - cue.release.value_or(0.0))
      continue;
    // A later cue is laid over an earlier one.
    strongest = {target->expression, cue.value};
  }
  return strongest;
}

/// Steps of a score one after another, by their true times: an error of rounding does not add up.
class ScoreMaker {
 public:
  explicit ScoreMaker(double begin) : begin_(begin) {}

  /// From the end of the step before to `end`, ms. A step that rounds to nothing is left out, unless a word begins with
  /// it or lips close in it.
  void add(std::uint8_t viseme, double end, bool begins_word) {
    const std::uint32_t at = score_.duration();
    const auto rounded =
        static_cast<std::uint32_t>(std::max(0.0, std::round((end - begin_) / score_unit))) * score_unit;
    const std::uint32_t least = viseme == closed_lips ? least_closure : begins_word ? score_unit : 0;
    const std::uint32_t until = std::max(rounded, at + least);
    if (until <= at) return;
    auto& steps = score_.steps;
    if (!begins_word && !steps.empty() && steps.back().viseme == viseme)
      steps.back().end = until;
    else
      steps.push_back({at, until, viseme, begins_word});
  }

  /// From the end of the newest step on.
  void express(std::uint8_t expression, double value) {
    const auto intensity = static_cast<std::uint8_t>(std::clamp(std::lround(value * 63.0), 0L, 63L));
    if (intensity == 0) expression = 0;
    const std::pair now{expression, expression == 0 ? std::uint8_t{0} : intensity};
    if (now == shown_) return;
    shown_ = now;
    score_.expressions.push_back({score_.duration(), now.first, now.second});
  }

  [[nodiscard]] SpeechScore take() { return std::move(score_); }

 private:
  const double begin_;
  SpeechScore score_;
  std::pair<std::uint8_t, std::uint8_t> shown_{0, 0};
};

}  // namespace

std::vector<SpeechText> speech_texts(const Speech& speech) {
  const Utterance& utterance = speech.utterance;
  const Characters characters(speech.text);
  const auto places = places_of(utterance, characters);
  if (places.empty()) return {};
  const auto parts = parts_of(speech, places, characters);
  const Loudness loudness(utterance);
  const auto segments = segments_of(utterance, sound_table(speech.sounds), loudness);
  std::vector<SpeechText> texts;
  std::size_t segment = 0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const bool last = p + 1 == parts.size();
    const std::size_t first_place = parts[p], end_place = last ? places.size() : parts[p + 1];
    const double begin = places[first_place].time;
    double end = last ? utterance.duration : places[end_place].time;
    const std::size_t from = p == 0 ? 0 : with_opening(speech.text, places[first_place].byte);
    std::string_view text = std::string_view(speech.text).substr(from);
    if (!last) text = text.substr(0, with_opening(speech.text, places[end_place].byte) - from);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    // A text without spaces may still be too long for a message; what is cut off is said by nobody.
    if (text.size() > max_speech_text_bytes) {
      std::size_t cut = max_speech_text_bytes;
      while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xC0U) == 0x80U) --cut;
      text = text.substr(0, cut);
    }

    // When each word of the text begins: with the first place in it; one in which nothing is said, with the next word.
    std::vector<double> words;
    std::size_t place = first_place;
    const auto begins = word_begins(text);
    for (std::size_t w = 0; w < begins.size(); ++w) {
      const std::size_t until = w + 1 < begins.size() ? from + begins[w + 1] : from + text.size();
      words.push_back(place < end_place ? places[place].time : end);
      while (place < end_place && places[place].byte < until) ++place;
    }

    while (segment < segments.size() && segments[segment].end <= begin) ++segment;
    std::size_t past = segment;
    while (past < segments.size() && segments[past].begin < end) ++past;
    while (past > segment && segments[past - 1].is_silence()) end = segments[--past].begin;

    ScoreMaker score(begin);
    std::size_t word = 0;
    for (std::size_t s = segment; s < past; ++s) {
      const std::uint8_t viseme = segments[s].is_silence() ? 0 : viseme_of(segments[s]);
      double time = std::max(begin, segments[s].begin);
      const double until = std::min(end, segments[s].end);
      const auto [expression, value] = expression_at(speech.performance, time);
      score.express(expression, value);
      while (time < until) {
        const std::size_t before = word;
        while (word < words.size() && words[word] <= time) ++word;
        for (std::size_t silent = before + 1; silent < word; ++silent) score.add(0, time, true);
        const double next = word < words.size() ? std::min(until, words[word]) : until;
        score.add(viseme, next, word > before);
        time = next;
      }
    }
    for (; word < words.size(); ++word) score.add(0, end, true);
    SpeechText message;
    message.media_time = static_cast<std::uint64_t>(std::llround(std::max(0.0, begin)));
    message.language = speech.sounds;
    message.text = text;
    message.score = write_score(score.take());
    if (message.score.size() > max_score_bytes) continue;  // a quarter of an hour in one sentence
    if (!message.text.empty()) texts.push_back(std::move(message));
  }
  return texts;
}

}  // namespace semblante::voice

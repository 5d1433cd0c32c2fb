#include "server/voice/speech_texts.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/speech/characters.h"
#include "core/speech/segments.h"
#include "core/speech/text_breaks.h"
#include "protocol/cpp/speech_score.h"

namespace semblante::voice {
namespace {

/// Longer sentences are divided, at a word: they are said in one go by voices that some browsers stop after a quarter
/// of a minute.
constexpr std::size_t longest_part = 300;     ///< bytes
constexpr std::size_t longest_language = 64;  ///< bytes, of a message
constexpr std::uint8_t closed_lips = 1;       ///< the viseme of p, b, m
/// A shorter closure of the lips may fall between two frames of 25 a second.
constexpr std::uint32_t least_closure = 2 * score_unit;

/// A word that was said: where it begins, in bytes of the text, and when.
struct Place {
  std::size_t byte = 0;
  double time = 0.0;
};

std::vector<Place> places_of(const Utterance& utterance, const Characters& characters) {
  std::vector<Place> places;
  for (const SpokenWord& word : utterance.words) places.push_back({characters.byte_of(word.range.first), word.time});
  return places;
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
    // A voice may tell the first one only.
    if (i > 0 && sentences.size() < 2)
      begins = is_sentence_end(text.substr(places[i - 1].byte, places[i].byte - places[i - 1].byte));
    const std::size_t end = i + 1 < places.size() ? places[i + 1].byte : text.size();
    if (begins || end - places[parts.back()].byte > longest_part) parts.push_back(i);
  }
  return parts;
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

/// A sentence, or a part of one.
struct Part {
  double begin = 0.0, end = 0.0;  ///< ms
  std::size_t from = 0;           ///< byte of the text of the speech
  std::string_view text;
  std::span<const Place> places;
};

Part part_from(const Speech& speech, std::span<const Place> places, bool is_first, const Place* next) {
  const std::string_view whole = speech.text;
  Part part{places.front().time, next != nullptr ? next->time : speech.utterance.duration, 0, {}, places};
  part.from = is_first ? 0 : with_opening(whole, places.front().byte);
  const std::size_t end = next != nullptr ? with_opening(whole, next->byte) : whole.size();
  part.text = whole.substr(part.from, end - part.from);
  while (!part.text.empty() && separates_words(part.text.back())) part.text.remove_suffix(1);
  // A text without spaces may still be too long for a message; what is cut off is said by nobody.
  if (part.text.size() > max_speech_text_bytes) {
    std::size_t cut = max_speech_text_bytes;
    while (cut > 0 && (static_cast<unsigned char>(part.text[cut]) & 0xC0U) == 0x80U) --cut;
    part.text = part.text.substr(0, cut);
  }
  return part;
}

/// When each word of the part begins: with the first place in it; one in which nothing is said, with the next word.
std::vector<double> words_of(const Part& part) {
  std::vector<double> words;
  auto place = part.places.begin();
  const auto begins = word_begins(part.text);
  for (std::size_t w = 0; w < begins.size(); ++w) {
    const std::size_t until = part.from + (w + 1 < begins.size() ? begins[w + 1] : part.text.size());
    words.push_back(place != part.places.end() ? place->time : part.end);
    while (place != part.places.end() && place->byte < until) ++place;
  }
  return words;
}

/// `segments`: those of the part, without the pause after it, which may reach beyond it.
SpeechScore score_of(const Part& part, std::span<const Segment> segments, const PerformanceScript& performance) {
  ScoreMaker score(part.begin);
  const auto words = words_of(part);
  std::size_t word = 0;
  for (const Segment& segment : segments) {
    const std::uint8_t viseme = segment.is_silence() ? 0 : viseme_of(segment);
    double time = std::max(part.begin, segment.begin);
    const double until = std::min(part.end, segment.end);
    const auto [expression, value] = expression_at(performance, time);
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
  for (; word < words.size(); ++word) score.add(0, part.end, true);
  return score.take();
}

}  // namespace

std::vector<SpeechText> speech_texts(const Speech& speech) {
  const Characters characters(speech.text);
  const auto places = places_of(speech.utterance, characters);
  if (places.empty()) return {};
  const auto parts = parts_of(speech, places, characters);
  const auto segments = segments_of(speech.utterance, sound_table(speech.sounds), Loudness(speech.utterance));
  const std::string language = speech.sounds.size() <= longest_language ? speech.sounds : "";
  std::vector<SpeechText> texts;
  std::size_t first = 0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const std::size_t end = p + 1 < parts.size() ? parts[p + 1] : places.size();
    const auto part = part_from(speech, std::span(places).subspan(parts[p], end - parts[p]), p == 0,
                                end < places.size() ? &places[end] : nullptr);
    while (first < segments.size() && segments[first].end <= part.begin) ++first;
    std::size_t past = first;
    while (past < segments.size() && segments[past].begin < part.end) ++past;
    while (past > first && segments[past - 1].is_silence()) --past;
    const auto score = score_of(part, std::span(segments).subspan(first, past - first), speech.performance);
    SpeechText text{0, static_cast<std::uint64_t>(std::llround(std::max(0.0, part.begin))), language,
                    std::string(part.text), write_score(score)};
    // Beyond that it is a quarter of an hour in one sentence.
    if (!text.text.empty() && text.score.size() <= max_score_bytes) texts.push_back(std::move(text));
  }
  return texts;
}

}  // namespace semblante::voice

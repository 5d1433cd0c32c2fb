#include <cmath>

#include <nlohmann/json.hpp>

#include "core/speech/characters.h"
#include "core/speech/segments.h"
#include "core/speech/speech.h"
#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

using Json = nlohmann::ordered_json;

double rounded(double ms) { return std::round(ms * 10.0) / 10.0; }

/// When the next of a list begins, or the utterance ends.
template <class Event>
double end_of(const std::vector<Event>& events, std::size_t i, const Utterance& utterance) {
  return i + 1 < events.size() ? events[i + 1].time : utterance.duration;
}

}  // namespace

std::string timeline_json(const Utterance& utterance, std::string_view text, std::string_view language) {
  const Characters characters(text);
  const Loudness loudness(utterance);
  const auto segments = segments_of(utterance, sound_table(language), loudness);
  Json timeline = {
      {"format", "semblante.timeline"}, {"version", 1}, {"duration", rounded(utterance.duration)}, {"text", text}};
  Json& sentences = timeline["sentences"] = Json::array();
  for (const SpokenSentence& sentence : utterance.sentences)
    sentences.push_back({{"time", rounded(sentence.time)}, {"first", sentence.first}});
  Json& words = timeline["words"] = Json::array();
  for (std::size_t i = 0; i < utterance.words.size(); ++i) {
    const SpokenWord& word = utterance.words[i];
    double end = end_of(utterance.words, i, utterance);
    for (const Segment& segment : segments)
      if (segment.is_silence() && segment.begin > word.time) {
        end = std::min(end, segment.begin);
        break;
      }
    words.push_back({{"time", rounded(word.time)},
                     {"end", rounded(end)},
                     {"first", word.range.first},
                     {"count", word.range.count},
                     {"text", characters.of(word.range)}});
  }
  Json& phonemes = timeline["phonemes"] = Json::array();
  for (std::size_t i = 0; i < utterance.phonemes.size(); ++i) {
    const SpokenPhoneme& phoneme = utterance.phonemes[i];
    phonemes.push_back({{"time", rounded(phoneme.time)},
                        {"end", rounded(end_of(utterance.phonemes, i, utterance))},
                        {"ipa", phoneme.symbol},
                        {"stress", stress_names[static_cast<std::size_t>(phoneme.stress)]}});
  }
  Json& visemes = timeline["visemes"] = Json::array();
  for (const Segment& segment : segments)
    visemes.push_back({{"time", rounded(segment.begin)},
                       {"end", rounded(segment.end)},
                       {"viseme", mpeg4::visemes[segment.sound.viseme].name}});
  Json& marks = timeline["marks"] = Json::array();
  for (const SpokenMark& mark : utterance.marks) marks.push_back({{"time", rounded(mark.time)}, {"name", mark.name}});
  return timeline.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace semblante

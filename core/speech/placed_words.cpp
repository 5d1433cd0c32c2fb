// The words and sentences of a timeline at their places in the text.
#include <algorithm>
#include <utility>

#include "core/speech/characters.h"
#include "core/speech/voice_timeline.h"
#include "core/types/printable.h"

namespace semblante {
namespace {

constexpr double past_the_sound_ms = 1000.0;  ///< that an event may come
constexpr double same_time_ms = 0.1;          ///< what rounding does to a time

/// Where `piece` is in the text, at or shortly after `from`.
std::size_t find_near(std::string_view text, std::string_view piece, std::size_t from) {
  constexpr std::size_t window = 400;
  const std::size_t at = text.substr(from, window + piece.size()).find(piece);
  return at == std::string_view::npos ? at : from + at;
}

/// Counts characters up to bytes that do not decrease.
class CharacterCount {
 public:
  explicit CharacterCount(std::string_view text) : text_(text) {}
  std::size_t at(std::size_t byte) {
    for (; byte_ < byte; ++count_) byte_ += utf8_step(text_.substr(byte_));
    return count_;
  }

 private:
  std::string_view text_;
  std::size_t byte_ = 0, count_ = 0;
};

}  // namespace

std::string text_of(const VoiceTimeline& timeline) {
  if (!timeline.text.empty()) return timeline.text;
  std::string text;
  for (const TimedText& piece : timeline.sentences.empty() ? timeline.words : timeline.sentences) {
    if (piece.text.empty()) continue;
    if (!text.empty()) text += ' ';
    text += piece.text;
  }
  return text;
}

Result<Utterance> utterance_of(const VoiceTimeline& timeline, std::string_view text, std::optional<Recording> sound,
                               std::size_t* missing) {
  Utterance said;
  said.voice = timeline_format_names[static_cast<std::size_t>(timeline.format)];
  said.duration = timeline.end;
  if (sound) {
    said.sample_rate = sound->sample_rate;
    said.samples = std::move(sound->samples);
    said.duration = 1000.0 * static_cast<double>(said.samples.size()) / said.sample_rate;
    if (timeline.end > said.duration + past_the_sound_ms)
      return Error{ErrorCode::mismatch, "", "the timeline is longer than the sound: they do not belong together"};
  }
  said.phonemes = timeline.phonemes;
  said.marks = timeline.marks;
  std::size_t lost = 0, from = 0;
  const bool own = !timeline.text.empty() && text == timeline.text;
  const Characters characters(text);
  CharacterCount words_count(text), sentences_count(text);
  for (const TimedText& word : timeline.words) {
    if (own && word.first) {
      const TextRange range{*word.first, Characters(word.text).count()};
      if (range.count > 0 && characters.of(range) == word.text)
        said.words.push_back({word.time, range});
      else
        ++lost;
      continue;
    }
    const std::size_t at = word.text.empty() ? std::string_view::npos : find_near(text, word.text, from);
    if (at == std::string_view::npos) {
      ++lost;
      continue;
    }
    from = at + word.text.size();
    const std::size_t first = words_count.at(at);
    said.words.push_back({word.time, {first, words_count.at(from) - first}});
  }
  from = 0;
  for (const TimedText& sentence : timeline.sentences) {
    if (sentence.first) {
      // In another text a sentence begins with its first word.
      const auto word = std::lower_bound(said.words.begin(), said.words.end(), sentence.time - same_time_ms,
                                         [](const SpokenWord& one, double time) { return one.time < time; });
      if (own && *sentence.first <= characters.count())
        said.sentences.push_back({sentence.time, *sentence.first});
      else if (!own && word != said.words.end())
        said.sentences.push_back({sentence.time, word->range.first});
      continue;
    }
    const std::size_t at = sentence.text.empty() ? std::string_view::npos : find_near(text, sentence.text, from);
    if (at == std::string_view::npos) continue;
    from = at + sentence.text.size();
    said.sentences.push_back({sentence.time, sentences_count.at(at)});
  }
  if (missing != nullptr) *missing = lost;
  return said;
}

}  // namespace semblante

#include "core/speech/speech.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/expressions/library.h"
#include "core/speech/life.h"
#include "core/speech/loudness.h"
#include "core/speech/mouth.h"
#include "core/speech/segments.h"
#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

/// When the words of a range are said: from the first one's beginning to the last one's end. Of an utterance whose
/// words are not known, everything.
std::optional<Interval> time_of(const TextRange& range, const Utterance& utterance, std::span<const Segment> segments) {
  std::optional<Interval> found;
  if (utterance.words.empty()) {
    for (const Segment& segment : segments)
      if (!segment.is_silence()) found = Interval{found ? found->begin : segment.begin, segment.end};
    // Nothing is said: the face shows it for as long as there is time.
    if (!found && utterance.duration > emotion_release_ms)
      found = Interval{0.0, utterance.duration - emotion_release_ms};
    return found;
  }
  for (std::size_t i = 0; i < utterance.words.size(); ++i) {
    const SpokenWord& word = utterance.words[i];
    if (word.range.first >= range.first + range.count || word.range.first + word.range.count <= range.first) continue;
    double end = i + 1 < utterance.words.size() ? utterance.words[i + 1].time : utterance.duration;
    for (const Segment& segment : segments)
      if (segment.is_silence() && segment.begin > word.time) {
        end = std::min(end, segment.begin);
        break;
      }
    if (!found) found = Interval{word.time, end};
    found->end = std::max(found->end, end);
  }
  return found;
}

constexpr std::array liveliness_of = {0.4, 1.0, 1.6};  ///< factor on brows, nods and turns, by SpeechStyle

bool moves_brows(std::uint8_t expression) { return expression != 1; }  // joy leaves them at rest

/// Eq. 5 leaves an expression 15 % of the mouth beside a viseme. The corners show a mood and are free in speech: they
/// keep `corner_share` of the expression by their own FAPs, in speech as in silence.
constexpr double corner_share = 0.5, least_corner_units = 40.0;
void add_corners(const Cue& expression, std::vector<Cue>& cues) {
  const auto& target = std::get<ExpressionTarget>(expression.target);
  for (const std::uint8_t fap : {12, 13, 59, 60}) {  // heights of the inner and outer corners
    const mpeg4::Fap& entry = mpeg4::fap(fap);
    for (const Displacement& part : expression_library()[target.expression].displacements) {
      if (part.point.value() != entry.feature_points[0]) continue;
      const double units = entry.sign * static_cast<double>(part.value[entry.axis]) * corner_share;
      if (std::abs(units) < least_corner_units) continue;
      Cue cue = expression;
      cue.target = FapTarget{fap};
      cue.value = std::round(units * expression.value);
      cues.push_back(std::move(cue));
    }
  }
}

}  // namespace

PerformanceScript speech_performance(const Utterance& utterance, std::span<const EmotionSpan> emotions,
                                     const SpeechOptions& options) {
  const Loudness loudness(utterance);
  const auto segments = segments_of(utterance, sound_table(options.language), loudness);
  PerformanceScript script;
  script.name = options.name;
  script.idle = IdleLife{.seed = options.seed, .blinks_per_minute = 0.0};

  // Smileys in a row, or spans around the same words, are one mood: the strongest of its kind.
  std::vector<Cue> moods;
  for (const EmotionSpan& span : emotions) {
    if (span.expression == 0 || span.intensity <= 0.0) continue;
    const auto said = time_of(span.range, utterance, segments);
    if (!said) continue;
    Cue cue;
    cue.time = std::max(0.0, std::round(said->begin - emotion_lead_ms));
    cue.duration = std::round(std::min(said->end + emotion_release_ms, utterance.duration) - cue.time);
    if (!(*cue.duration > 0.0)) continue;
    cue.attack = std::floor(std::min(emotion_lead_ms, 0.3 * *cue.duration));
    cue.release = std::floor(std::min(emotion_release_ms, 0.6 * *cue.duration));
    cue.target = ExpressionTarget{span.expression};
    cue.value = span.intensity;
    const auto same = std::find_if(moods.begin(), moods.end(), [&cue](const Cue& mood) {
      return mood.time == cue.time && mood.duration == cue.duration &&
             std::get<ExpressionTarget>(mood.target).expression == std::get<ExpressionTarget>(cue.target).expression;
    });
    if (same == moods.end())
      moods.push_back(std::move(cue));
    else
      same->value = std::max(same->value, cue.value);
  }
  std::vector<Interval> expressive, brows_taken;
  for (Cue& cue : moods) {
    const Interval interval = {cue.time, cue.time + *cue.duration};
    expressive.push_back(interval);
    if (moves_brows(std::get<ExpressionTarget>(cue.target).expression)) brows_taken.push_back(interval);
    add_corners(cue, script.cues);
    script.cues.push_back(std::move(cue));
  }
  for (Cue& cue : mouth_cues(segments, expressive)) script.cues.push_back(std::move(cue));
  for (Cue& cue :
       life_cues(segments, loudness, brows_taken, options.seed, liveliness_of[static_cast<std::size_t>(options.style)]))
    script.cues.push_back(std::move(cue));
  std::stable_sort(script.cues.begin(), script.cues.end(), [](const Cue& a, const Cue& b) { return a.time < b.time; });
  double end = utterance.duration;
  for (const Cue& cue : script.cues) end = std::max(end, cue.time + cue.duration.value_or(1000.0));
  script.duration = std::ceil(end);
  return script;
}

}  // namespace semblante

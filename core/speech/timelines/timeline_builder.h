#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/speech/timelines/viseme_symbols.h"
#include "core/speech/voice_timeline.h"
#include "core/types/result.h"

namespace semblante {

inline constexpr double most_timeline_ms = max_speech_seconds * 1000.0;
inline constexpr std::size_t most_symbol_bytes = 32;

/// Takes the events of a file, with every check that all formats have in common. Times in ms; `where`: the line or JSON
/// pointer of an event, for errors. The first error is kept, and what comes after it is left out.
class TimelineBuilder {
 public:
  /// `symbols`: of the visemes that the sounds are; null: they are phonemes in IPA.
  TimelineBuilder(TimelineFormat format, const VisemeSymbols* symbols);

  /// A viseme of the system, or a phoneme with its marks of stress. `end`: unknown without.
  void sound(std::string_view symbol, double time, std::optional<double> end, const std::string& where);
  void stressed_sound(SpokenPhoneme phoneme, std::optional<double> end, const std::string& where);
  void word(double time, std::string text, const std::string& where);
  void sentence(double time, std::string text, const std::string& where);
  /// Of a file that has the whole text.
  void whole_text(std::string text);
  /// `first`: the first character in the whole text.
  void placed_word(double time, std::string text, std::size_t first, const std::string& where);
  void placed_sentence(double time, std::size_t first, const std::string& where);
  void mark(double time, std::string_view name, const std::string& where);
  /// The sound goes on to here.
  void reach(double ms);

  void fail(ErrorCode code, std::string where, std::string message);
  [[nodiscard]] bool failed() const { return fault_.has_value(); }

  Result<VoiceTimeline> finish() &&;

 private:
  /// Whether the time is good for the next event of the list.
  template <class Event>
  bool take_time(double time, const std::vector<Event>& events, const std::string& where);

  VoiceTimeline timeline_;
  const VisemeSymbols* symbols_;
  std::optional<double> sound_end_;  ///< of the last sound, where it is known
  std::optional<Error> fault_;
  std::size_t events_ = 0;
};

}  // namespace semblante

#include "core/speech/timelines/timeline_builder.h"

#include <algorithm>
#include <utility>

#include "core/types/printable.h"

namespace semblante {
namespace {

constexpr double ms_per_s = 1000.0;
constexpr double least_gap_ms = 20.0;  ///< a shorter one between two sounds is none
/// Three times as many as anybody says; more would take long to animate.
constexpr std::size_t most_sounds_a_second = 60;
constexpr double last_sound_ms = 200.0;  ///< of a sound whose end nobody says

/// Control characters of a text become spaces.
std::string on_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(),
      [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte < 0x20 || byte == 0x7F;
      },
      ' ');
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? std::string() : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

}  // namespace

TimelineBuilder::TimelineBuilder(TimelineFormat format, const VisemeSymbols* symbols) : symbols_(symbols) {
  timeline_.format = format;
  timeline_.of_visemes = symbols != nullptr;
}

template <class Event>
bool TimelineBuilder::take_time(double time, const std::vector<Event>& events, const std::string& where) {
  if (failed()) return false;
  if (++events_ > max_timeline_events) {
    fail(ErrorCode::too_large, where, "there are more than " + std::to_string(max_timeline_events) + " events");
  } else if (!(time >= 0.0 && time <= most_timeline_ms)) {
    fail(ErrorCode::out_of_range, where,
         "a time must be within " + std::to_string(static_cast<int>(max_speech_seconds)) + " s");
  } else if (!events.empty() && time < events.back().time) {
    fail(ErrorCode::out_of_range, where, "times must not decrease");
  }
  reach(failed() ? 0.0 : time);
  return !failed();
}

void TimelineBuilder::sound(std::string_view symbol, double time, std::optional<double> end, const std::string& where) {
  SpokenPhoneme phoneme;
  phoneme.time = time;
  if (symbols_ != nullptr) {
    const VisemeSymbol* const found = symbols_->find(symbol);
    if (found == nullptr)
      return fail(ErrorCode::out_of_range, where,
                  "there is no \"" + printable(symbol) + "\" among the symbols of " + std::string(symbols_->system));
    phoneme.symbol = found->ipa;
  } else {
    constexpr std::string_view primary = "ˈ", secondary = "ˌ";
    if (symbol.starts_with(primary)) phoneme.stress = Stress::primary;
    if (symbol.starts_with(secondary)) phoneme.stress = Stress::secondary;
    if (phoneme.stress != Stress::none) symbol.remove_prefix(primary.size());
    if (symbol.size() > most_symbol_bytes) return fail(ErrorCode::too_large, where, "a phoneme is too long");
    phoneme.symbol = symbol == "sil" || symbol == "_" ? "" : printable(symbol);
  }
  stressed_sound(std::move(phoneme), end, where);
}

void TimelineBuilder::stressed_sound(SpokenPhoneme phoneme, std::optional<double> end, const std::string& where) {
  if (!take_time(phoneme.time, timeline_.phonemes, where)) return;
  if (end && !(*end >= phoneme.time && *end <= most_timeline_ms))
    return fail(ErrorCode::out_of_range, where, "ends before it begins, or after the longest speech");
  const auto& sounds = timeline_.phonemes;
  if (sounds.size() >= most_sounds_a_second &&
      phoneme.time - sounds[sounds.size() - most_sounds_a_second].time < ms_per_s)
    return fail(ErrorCode::too_large, where,
                "there are more than " + std::to_string(most_sounds_a_second) + " sounds within a second");
  if (sound_end_ && phoneme.time - *sound_end_ >= least_gap_ms) timeline_.phonemes.push_back({*sound_end_, ""});
  sound_end_ = end;
  reach(end.value_or(phoneme.time));
  timeline_.phonemes.push_back(std::move(phoneme));
}

void TimelineBuilder::word(double time, std::string text, const std::string& where) {
  if (take_time(time, timeline_.words, where)) timeline_.words.push_back({time, on_one_line(std::move(text))});
}

void TimelineBuilder::sentence(double time, std::string text, const std::string& where) {
  if (take_time(time, timeline_.sentences, where)) timeline_.sentences.push_back({time, on_one_line(std::move(text))});
}

void TimelineBuilder::whole_text(std::string text) {
  std::replace_if(
      text.begin(), text.end(),
      [](char c) { return (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') || c == 0x7F; }, ' ');
  timeline_.text = std::move(text);
}

void TimelineBuilder::placed_word(double time, std::string text, std::size_t first, const std::string& where) {
  if (take_time(time, timeline_.words, where)) timeline_.words.push_back({time, std::move(text), first});
}

void TimelineBuilder::placed_sentence(double time, std::size_t first, const std::string& where) {
  if (take_time(time, timeline_.sentences, where)) timeline_.sentences.push_back({time, "", first});
}

void TimelineBuilder::mark(double time, std::string_view name, const std::string& where) {
  if (take_time(time, timeline_.marks, where)) timeline_.marks.push_back({time, printable(name)});
}

void TimelineBuilder::reach(double ms) { timeline_.end = std::max(timeline_.end, ms); }

void TimelineBuilder::fail(ErrorCode code, std::string where, std::string message) {
  if (!fault_) fault_ = Error{code, std::move(where), std::move(message)};
}

Result<VoiceTimeline> TimelineBuilder::finish() && {
  if (fault_) return *std::move(fault_);
  if (timeline_.phonemes.empty()) return Error{ErrorCode::empty, "", "the timeline has no sounds"};
  const bool fills_the_sound = !timeline_.text.empty() && sound_end_ && *sound_end_ >= timeline_.end;
  if (sound_end_ && !fills_the_sound && !timeline_.phonemes.back().symbol.empty())
    timeline_.phonemes.push_back({*sound_end_, ""});
  if (!timeline_.phonemes.back().symbol.empty() && timeline_.phonemes.back().time >= timeline_.end)
    timeline_.end = timeline_.phonemes.back().time + last_sound_ms;
  return std::move(timeline_);
}

}  // namespace semblante

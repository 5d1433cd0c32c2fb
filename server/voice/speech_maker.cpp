#include "server/voice/speech_maker.h"

#include <algorithm>
#include <utility>

#include "core/speech/alignment.h"
#include "core/speech/hearing.h"
#include "core/speech/loudness.h"
#include "core/speech/marked_ssml.h"
#include "core/speech/marked_text.h"
#include "core/speech/sounds.h"
#include "core/types/printable.h"

namespace semblante::voice {
namespace {

constexpr const char* sounds_of_visemes = "en";  // the table that has the sounds of viseme_symbols.h

std::string no_table_warning(const std::string& language) {
  return printable(language) + " has no table of sounds of its own: mouths are those of English";
}

Error in(const char* part, const Error& error) {
  const bool pointer = error.where.starts_with('/');
  return {error.code, part + (pointer ? error.where : ""),
          error.where.empty() || pointer ? error.message : error.where + ": " + error.message};
}

/// Of frames (tests/bench/README.md, bench_alignment): the text that is said has 1.02 to 1.20, in recordings of a
/// reader and of three synthetic voices; another text 1.24 to 1.37.
constexpr double doubtful_distance = 1.22;

Result<MarkedText> marked_text_of(const std::string& text) {
  if (const auto checked = check_text(text); !checked)
    return in("text", {checked.error().code, "", checked.error().message});
  auto read = read_marked_text(text);
  if (!read) return in("text", {read.error().code, "", read.error().message});
  return read;
}

void add_whole(MarkedText& marked, std::uint8_t expression, double intensity) {
  if (expression != 0)
    marked.emotions.insert(marked.emotions.begin(), {expression, intensity, {0, marked.text.size()}});
}

}  // namespace

Result<Speech> make_speech(const VoiceProgram& program, const SpeechRequest& request) {
  // Marks are read after the checks: it must be text at all.
  if (const auto checked = check(request.voice); !checked) return checked.error();
  VoiceRequest wish = request.voice;
  MarkedText marked;
  MarkedSsml ssml;
  bool ends_here = true;
  if (wish.ssml) {
    auto read = read_marked_ssml(wish.text);
    if (!read) return read.error();
    ssml = *std::move(read);
    marked = ssml.said;
  } else {
    auto read = read_marked_text(wish.text);
    if (!read) return read.error();
    marked = *std::move(read);
  }
  add_whole(marked, request.expression, request.intensity);
  if (!wish.ssml) {
    const Prosody prosody = prosody_of(marked);
    wish.rate = std::clamp(wish.rate * prosody.rate, least_factor, most_factor);
    wish.pitch = std::clamp(wish.pitch * prosody.pitch, least_factor, most_factor);
  }
  if (request.part && !wish.ssml) {
    const auto parts = first_part(wish.text);
    if (!parts) return parts.error();
    auto read = read_marked_text(parts->first);
    if (!read) return read.error();
    marked = *std::move(read);
    add_whole(marked, request.expression, request.intensity);
    ends_here = parts->rest.empty();
  }
  wish.text = wish.ssml ? ssml.document : marked.text;
  auto spoken = speak(program, wish);
  if (!spoken) return spoken.error();
  if (wish.ssml) place_in_text(ssml, *spoken);
  Speech speech;
  speech.text = std::move(marked.text);
  speech.utterance = with_silence(*std::move(spoken), speech_lead_ms, ends_here ? speech_tail_ms : 0.0);
  if (!has_sound_table(wish.language)) speech.warnings.push_back(no_table_warning(wish.language));
  SpeechOptions face = request.face;
  face.language = speech.sounds = wish.language;
  speech.performance = speech_performance(speech.utterance, marked.emotions, face);
  return speech;
}

Result<Speech> make_speech(const TimelineRequest& request) {
  if (const auto checked = check_language(request.language); !checked) return checked.error();
  const auto timeline = read_voice_timeline(request.timeline, request.format);
  if (!timeline) return in("timeline", timeline.error());
  MarkedText marked{text_of(*timeline), {}};
  if (!request.text.empty()) {
    auto read = marked_text_of(request.text);
    if (!read) return read.error();
    marked = *std::move(read);
  }
  add_whole(marked, request.expression, request.intensity);
  std::optional<Recording> sound;
  if (!request.sound.empty()) {
    auto read = read_sound(request.sound_reader, request.sound);
    if (!read) return in("audio", read.error());
    sound = *std::move(read);
  }
  std::size_t missing = 0;
  auto said = utterance_of(*timeline, marked.text, std::move(sound), &missing);
  if (!said) return in("audio", said.error());
  Speech speech;
  speech.text = std::move(marked.text);
  speech.utterance = *std::move(said);
  speech.sounds = timeline->of_visemes ? sounds_of_visemes : request.language;
  if (!has_sound_table(speech.sounds)) speech.warnings.push_back(no_table_warning(request.language));
  if (missing > 0)
    speech.warnings.push_back(std::to_string(missing) + " of " + std::to_string(timeline->words.size()) +
                              " words of the timeline are not in the text");
  if (timeline->words.empty()) speech.warnings.emplace_back("the timeline has no words: there are no captions");
  SpeechOptions face = request.face;
  face.language = speech.sounds;
  speech.performance = speech_performance(speech.utterance, marked.emotions, face);
  return speech;
}

Result<Speech> make_speech(const VoiceProgram& voice, const SaidRequest& request) {
  if (const auto checked = check_language(request.language); !checked) return checked.error();
  MarkedText marked;
  if (!request.text.empty()) {
    auto read = marked_text_of(request.text);
    if (!read) return read.error();
    marked = *std::move(read);
  }
  auto sound = read_sound(request.sound_reader, request.sound);
  if (!sound) return in("audio", sound.error());
  Speech speech;
  if (request.text.empty()) {
    speech.utterance = hear(*std::move(sound));
    speech.sounds = sounds_of_visemes;
    speech.warnings.emplace_back("nobody gave the text: mouths are as they are heard, and there are no captions");
  } else {
    VoiceRequest wish;
    wish.text = marked.text;
    wish.language = request.language;
    const auto model = speak(voice, wish);
    if (!model) return model.error();
    auto aligned = align(*model, *sound);
    if (!aligned) return in(aligned.error().code == ErrorCode::mismatch ? "text" : "audio", aligned.error());
    speech.utterance = std::move(aligned->utterance);
    speech.utterance.voice = "recording";
    speech.sounds = request.language;
    if (!has_sound_table(request.language)) speech.warnings.push_back(no_table_warning(request.language));
    if (aligned->distance > doubtful_distance)
      speech.warnings.emplace_back("the sound hardly resembles the text: is this what is said?");
  }
  add_whole(marked, request.expression, request.intensity);
  speech.text = std::move(marked.text);
  SpeechOptions face = request.face;
  face.language = speech.sounds;
  speech.performance = speech_performance(speech.utterance, marked.emotions, face);
  return speech;
}

}  // namespace semblante::voice

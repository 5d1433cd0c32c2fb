#include "server/voice/speech_maker.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/speech/alignment.h"
#include "core/speech/hearing.h"
#include "core/speech/loudness.h"
#include "core/speech/marked_ssml.h"
#include "core/speech/marked_text.h"
#include "core/speech/sounds.h"
#include "core/speech/whole_words.h"
#include "core/types/printable.h"
#include "server/voice/speech_texts.h"

namespace semblante::voice {
namespace {

constexpr const char* sounds_of_visemes = "en";  // the table that has the sounds of viseme_symbols.h

std::string no_table_warning(const std::string& language) {
  return printable(language) +
         " has no table of sounds of its own: mouths are by the chart of IPA, and were not measured";
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

Result<SpeechRequest> with_prosody(SpeechRequest request) {
  // Marks are read after the checks: it must be text at all.
  if (const auto checked = check(request.voice); !checked) return checked.error();
  if (request.voice.ssml) return request;
  auto marked = read_marked_text(request.voice.text);
  if (!marked) return marked.error();
  add_whole(*marked, request.expression, request.intensity);
  const Prosody prosody = prosody_of(*marked);
  request.voice.rate = std::clamp(request.voice.rate * prosody.rate, least_factor, most_factor);
  request.voice.pitch = std::clamp(request.voice.pitch * prosody.pitch, least_factor, most_factor);
  return request;
}

/// What is said of a text with its marks.
struct Spoken {
  MarkedText marked;
  Utterance utterance;
};

/// What is said of "😀": nothing, for so long that the face can show it.
Utterance silent_face() {
  constexpr double silent_face_ms = 2'000.0;
  Utterance silence;
  silence.voice = "none";
  silence.sample_rate = least_sample_rate;
  silence.duration = silent_face_ms;
  silence.samples.resize(static_cast<std::size_t>(silent_face_ms * least_sample_rate / 1000.0));
  silence.phonemes = {{0.0, "", Stress::none}};
  return silence;
}

/// `text`: of the request, or a part of it.
Result<Spoken> spoken(const VoiceProgram& program, const SpeechRequest& request, std::string_view text,
                      const std::function<bool()>& wanted = {}) {
  VoiceRequest wish = request.voice;
  MarkedSsml ssml;
  Spoken said;
  if (wish.ssml) {
    auto read = read_marked_ssml(text);
    if (!read) return read.error();
    ssml = *std::move(read);
    said.marked = ssml.said;
    wish.text = ssml.document;
  } else {
    auto read = read_marked_text(text);
    if (!read) return read.error();
    said.marked = *std::move(read);
    wish.text = said.marked.text;
  }
  add_whole(said.marked, request.expression, request.intensity);
  if (says_nothing(wish.text) && !said.marked.emotions.empty()) {
    said.utterance = silent_face();
    return said;
  }
  auto utterance = speak(program, wish, wanted);
  if (!utterance) return utterance.error();
  if (wish.ssml) place_in_text(ssml, *utterance);
  said.utterance = *std::move(utterance);
  return said;
}

/// Nothing is left to say in it but marks.
bool is_blank(const std::string& text) {
  const auto marked = read_marked_text(text);
  return marked && says_nothing(marked->text);
}

/// Makes the utterance of a sound whose text nobody gave; the text, as far as it is heard.
std::string hear(const SaidRequest& request, Recording sound, Speech& speech) {
  const double seconds = static_cast<double>(sound.samples.size()) / sound.sample_rate;
  const bool asks = !request.recognizer.command.empty() && !request.recognizer.command[0].empty();
  std::string reason;
  if (asks && seconds > most_recognized_seconds) {
    reason = "; words are recognized in up to " + std::to_string(std::lround(most_recognized_seconds)) + " s";
  } else if (asks) {
    auto heard = recognize(request.recognizer, sound, request.language);
    if (heard && !heard->text.empty() && heard->confidence >= least_confidence) {
      speech.utterance = std::move(heard->said);
      speech.sounds = request.language;
      speech.warnings.push_back("nobody gave the text: the words are those that " + speech.utterance.voice +
                                " has heard, sure to " + std::to_string(std::lround(100.0 * heard->confidence)) +
                                " %; mouths are those of the words");
      if (!has_sound_table(speech.sounds)) speech.warnings.push_back(no_table_warning(speech.sounds));
      speech.utterance.voice = "recording, heard by " + speech.utterance.voice;
      speech.utterance.sample_rate = sound.sample_rate;
      speech.utterance.samples = std::move(sound.samples);
      return std::move(heard->text);
    }
    if (heard)
      reason = "; the recognizer is not sure of any words";
    else if (heard.error().where != "language")
      reason = "; the recognizer failed: " + heard.error().message;
  }
  speech.utterance = semblante::hear(std::move(sound));
  speech.sounds = sounds_of_visemes;
  speech.warnings.push_back(
      "nobody gave the text: mouths are as they are heard in the sound, six of ten moments right; there are no "
      "captions" +
      reason);
  return {};
}

/// Makes the face of a speech that has all else, and leaves out what is no word of its text, whoever named it.
void add_face(Speech& speech, std::span<const EmotionSpan> emotions, SpeechOptions face) {
  keep_whole_words(speech.utterance, speech.text);
  face.language = speech.sounds;
  speech.performance = speech_performance(speech.utterance, emotions, face);
}

}  // namespace

Result<TextParts> first_part_of(const VoiceRequest& request) {
  if (request.ssml) return first_part_of_ssml(request.text);
  return first_part(request.text);
}

Result<Speech> make_speech(const VoiceProgram& program, const SpeechRequest& given) {
  const auto request = with_prosody(given);
  if (!request) return request.error();
  TextParts parts{request->voice.text, {}};
  if (request->part) {
    auto cut = first_part_of(request->voice);
    if (!cut) return cut.error();
    parts = *std::move(cut);
  }
  auto said = spoken(program, *request, parts.first);
  if (!said) return said.error();
  Speech speech;
  speech.text = std::move(said->marked.text);
  speech.utterance =
      with_silence(std::move(said->utterance), speech_lead_ms, parts.rest.empty() ? speech_tail_ms : 0.0);
  speech.sounds = request->voice.language;
  if (!has_sound_table(speech.sounds)) speech.warnings.push_back(no_table_warning(speech.sounds));
  add_face(speech, said->marked.emotions, request->face);
  return speech;
}

Result<SpeechParts> SpeechParts::read(VoiceProgram program, SpeechRequest request) {
  auto checked = with_prosody(std::move(request));
  if (!checked) return checked.error();
  return SpeechParts(std::move(program), *std::move(checked));
}

Result<SpeechPart> SpeechParts::next(const std::function<bool()>& wanted) {
  auto cut = first_part_of(request_.voice);
  if (!cut) return cut.error();
  TextParts parts = *std::move(cut);
  auto said = spoken(program_, request_, parts.first, wanted);
  // A voice says nothing of "* * *"; the text goes on.
  if (!said && said.error().code == ErrorCode::empty && !first_) {
    Spoken silent;
    silent.utterance.sample_rate = least_sample_rate;
    said = std::move(silent);
  }
  if (!said) return said.error();
  SpeechPart part;
  part.lead = first_ ? 0.0 : emotion_lead_ms;
  done_ = request_.voice.ssml ? parts.rest.empty() : is_blank(parts.rest);
  part.sound = with_silence(said->utterance, first_ ? speech_lead_ms : 0.0, done_ ? speech_tail_ms : 0.0);
  said_ms_ += part.sound.duration;
  if (said_ms_ > max_seconds * 1000.0)
    return Error{ErrorCode::too_large, "voice",
                 "speaks longer than " + std::to_string(std::lround(max_seconds)) + " s"};
  // The silence before and after the part is time in which the face gets ready and comes to rest.
  Speech seen;
  seen.utterance = with_silence(std::move(said->utterance), first_ ? speech_lead_ms : part.lead, speech_tail_ms);
  seen.text = std::move(said->marked.text);
  seen.sounds = request_.voice.language;
  add_face(seen, said->marked.emotions, request_.face);
  part.texts = speech_texts(seen);
  part.face = std::move(seen.performance);
  request_.voice.text = std::move(parts.rest);
  ++request_.face.seed;
  first_ = false;
  return part;
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
  add_face(speech, marked.emotions, request.face);
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
    marked.text = hear(request, *std::move(sound), speech);
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
  add_face(speech, marked.emotions, request.face);
  return speech;
}

}  // namespace semblante::voice

#include <algorithm>
#include <cmath>
#include <mutex>
#include <shared_mutex>
#include <span>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/json/read_json.h"
#include "core/performance/performance.h"
#include "core/speech/marked_ssml.h"
#include "core/speech/marked_text.h"
#include "core/speech/sounds.h"
#include "core/speech/speech.h"
#include "core/speech/voice_timeline.h"
#include "core/speech/wav.h"
#include "protocol/cpp/performance_document.h"
#include "protocol/hash/sha256.h"
#include "server/api/authorization.h"
#include "server/api/common.h"
#include "server/api/generated/body_members.h"
#include "server/api/generated/handlers.h"
#include "server/api/live_speech.h"
#include "server/api/mapped_file.h"
#include "server/api/play_options.h"
#include "server/api/quota.h"
#include "server/api/storage_problems.h"
#include "server/api/stored_file.h"
#include "server/http/media_type.h"
#include "server/http/multipart.h"
#include "server/voice/speech_maker.h"
#include "server/voice/speech_texts.h"

namespace semblante::api {
namespace {

using store::SpeechRecord;

constexpr unsigned retry_after_voices = 1;
constexpr std::string_view audio = "audio", timeline = "timeline", performance = "performance", captions = "captions";

std::string text_member(const JsonBody& body, const char* name) {
  if (!body.contains(name)) return {};
  if (!body[name].is_string()) refuse("invalid-field", "must be a string", std::string("/") + name);
  return body[name].get<std::string>();
}

/// The index of the member's value among the names; `otherwise` without the member.
template <class Names>
std::size_t choice_member(const JsonBody& body, const char* name, const Names& names, std::size_t otherwise) {
  if (!body.contains(name)) return otherwise;
  const auto value = text_member(body, name);
  const auto found = std::find(names.begin(), names.end(), value);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  std::string list;
  for (const auto& one : names) list.append(list.empty() ? "" : ", ").append(one);
  refuse("invalid-field", "must be one of " + list, std::string("/") + name);
}

/// What texts and timelines have in common.
template <class Wish>
void read_manner(const JsonBody& body, Wish& wish) {
  wish.expression = static_cast<std::uint8_t>(choice_member(body, "emotion", emotion_names(), 0));
  wish.intensity = number_or(body, "intensity", 1.0, 0.0, 1.0);
  wish.face.style = static_cast<SpeechStyle>(
      choice_member(body, "style", speech_style_names, static_cast<std::size_t>(SpeechStyle::normal)));
  const double seed = number_or(body, "seed", 0.0, 0.0, 4'294'967'295.0);
  if (seed != std::floor(seed)) refuse("invalid-field", "must be a whole number", "/seed");
  wish.face.seed = static_cast<std::uint32_t>(seed);
  wish.face.name = "speech";
}

voice::SpeechRequest speech_request(const JsonBody& body) {
  voice::SpeechRequest request;
  request.voice.text = text_member(body, "text");
  request.voice.ssml = flag_member(body, "ssml");
  request.voice.language = text_member(body, "language");
  request.voice.voice = text_member(body, "voice");
  request.voice.rate = number_or(body, "rate", 1.0, voice::least_factor, voice::most_factor);
  request.voice.pitch = number_or(body, "pitch", 1.0, voice::least_factor, voice::most_factor);
  request.part = flag_member(body, "part");
  read_manner(body, request);
  if (const auto checked = voice::check(request.voice); !checked)
    refuse("invalid-field", checked.error().message, "/" + checked.error().where);
  if (request.voice.ssml) {
    if (const auto marked = read_marked_ssml(request.voice.text); !marked)
      refuse("invalid-field", marked.error().message, "/text");
  } else if (const auto marked = read_marked_text(request.voice.text); !marked) {
    refuse("invalid-field", marked.error().message, "/text");
  } else if (says_nothing(marked->text) && marked->emotions.empty()) {
    refuse("invalid-field", "there is nothing to say, and no emotion to show", "/text");
  }
  return request;
}

void refuse_without_voice(const Context& context) {
  if (context.config.voice.command.empty())
    refuse("no-voice",
           "no voice is installed on the server: its administrator installs semblante-voice-espeak, or names another "
           "program by --voice-program");
}

auto take_voice_slot(Context& context) {
  auto slot = context.voices->take();
  if (!slot)
    refuse_for_now("as many voices are speaking as the server lets speak at the same time", retry_after_voices);
  return slot;
}

/// What a voice has made of a request.
template <class Made>
Made spoken(Result<Made> made) {
  if (!made && made.error().code == ErrorCode::unsupported)
    refuse("invalid-field", made.error().message, "/" + made.error().where);
  if (!made) refuse("voice-failed", "the voice: " + made.error().message);
  return *std::move(made);
}

SpeechRecord speech_of(Context& context, const http::Request& request) {
  const auto& id = request.params.at("speech");
  auto speech = context.store.speech(id);
  if (!speech) refuse("not-found", "there is no speech " + id);
  return std::move(*speech);
}

const store::ArtefactRecord& file_of(const SpeechRecord& speech, std::string_view name) {
  const auto found = std::find_if(speech.files.begin(), speech.files.end(),
                                  [name](const store::ArtefactRecord& file) { return file.name == name; });
  if (found == speech.files.end()) refuse("not-found", "the speech has no " + std::string(name));
  return *found;
}

std::filesystem::path whole_file(const Context& context, const SpeechRecord& speech, std::string_view name) {
  const auto& file = file_of(speech, name);
  return context.blobs.whole(file.sha256, file.bytes);
}

bool has_file(const SpeechRecord& speech, std::string_view name) {
  return std::any_of(speech.files.begin(), speech.files.end(),
                     [name](const store::ArtefactRecord& file) { return file.name == name; });
}

http::Response speech_file(Context& context, const http::Request& request, std::string_view name) {
  return file_response(context, request, file_of(speech_of(context, request), name), "no-cache");
}

/// What a speech of a part leaves to say. It follows from the request, and is not stored.
std::string rest_of(const SpeechRecord& speech) {
  const auto request = read_json(speech.request);
  if (!request || !request->value("part", false)) return {};
  voice::VoiceRequest said;
  said.text = request->value("text", "");
  said.ssml = request->value("ssml", false);
  const auto parts = voice::first_part_of(said);
  return parts ? parts->rest : std::string();
}

answer::Speech speech_answer(const SpeechRecord& speech) {
  const std::string self = "/v1/speeches/" + speech.id;
  const auto link = [&self](std::string_view name) { return self + "/" + std::string(name); };
  std::uint64_t bytes = 0;
  for (const auto& file : speech.files) bytes += file.bytes;
  return {.id = speech.id,
          .created = speech.created,
          .request = {speech.request},
          .text = speech.text,
          .rest = rest_of(speech),
          .made_by = speech.voice,
          .duration = speech.duration,
          .bytes = bytes,
          .warnings = speech.warnings,
          .links = {.self = self,
                    .audio = has_file(speech, audio) ? std::optional(link(audio)) : std::nullopt,
                    .timeline = link(timeline),
                    .performance = link(performance),
                    .captions = link(captions)}};
}

http::Response created(const SpeechRecord& speech) {
  auto response = json_response(201, speech_answer(speech));
  response.headers["Location"] = "/v1/speeches/" + speech.id;
  return response;
}

/// Stores the files; the caller holds the blobs' references.
void add_file(Context& context, SpeechRecord& speech, std::string_view name, std::string_view type,
              std::string_view bytes) {
  auto blob = context.blobs.put(bytes);
  if (!blob) refuse_unkept(blob.error());
  speech.files.push_back({std::string(name), blob->sha256, blob->bytes, std::string(type)});
}

auto take_speaker(Context& context) {
  auto place = context.speakers->place();
  if (!place)
    refuse_for_now("as many streams are speaking as the server lets speak at the same time", retry_after_voices);
  return place;
}

/// The sentences of a stored speech, from its timeline; none if nothing is known of its words.
std::vector<SpeechText> texts_of(Context& context, const SpeechRecord& record, const PerformanceScript& script) {
  const MappedFile file(whole_file(context, record, timeline));
  const auto read = read_voice_timeline(file.text(), TimelineFormat::semblante);
  if (!read) refuse("internal", "the timeline cannot be read: " + read.error().message);
  auto said = utterance_of(*read, record.text, {});
  if (!said) return {};
  voice::Speech speech;
  speech.text = record.text;
  speech.utterance = *std::move(said);
  speech.performance = script;
  const auto request = read_json(record.request);
  if (request) speech.sounds = request->value("language", "");
  return voice::speech_texts(speech);
}

/// Plays what has been made of a speech, and has the rest made.
http::Response play(Context& context, const http::Request& request, LiveSpeech speech, std::shared_ptr<void> place,
                    bool take_over) {
  streams::PlayOptions options;
  options.take_over = take_over;
  auto response = play_into(context, request.params.at("stream"), speech.source(), options);
  LiveSpeech::make_rest(std::move(speech), *context.speakers, std::move(place));
  return response;
}

/// Makes and keeps a speech, unless an earlier request with the same key and fingerprint has.
template <class Make>
http::Response create(Context& context, http::Request& request, std::string wish, const std::string& fingerprint,
                      Make make_it) {
  auto check = check_idempotency(context, request, fingerprint);
  if (check.earlier) {
    if (const auto earlier = context.store.speech(*check.earlier)) return created(*earlier);
    refuse("conflict", "what this Idempotency-Key created has been removed");
  }
  const auto most = context.config.limits.max_speeches;
  if (context.store.speech_count() >= most)
    refuse("limit-exceeded", "the server stores at most " + std::to_string(most) + " speeches: delete one");
  const auto turn = take_quota(context, request, {.bytes = 1, .speeches = 1});
  const voice::Speech made = make_it();

  SpeechRecord speech;
  speech.id = store::random_id();
  speech.created = store::timestamp_now();
  speech.request = std::move(wish);
  speech.text = made.text;
  speech.voice = made.utterance.voice;
  speech.duration = static_cast<std::uint64_t>(std::llround(made.utterance.duration));
  speech.warnings = made.warnings;
  speech.owner = origin_of(request).owner;
  if (check.record) check.record->resource = speech.id;
  // Protects the files from removal until the record that refers to them is stored.
  const std::shared_lock shared(context.blobs.references());
  if (!made.utterance.samples.empty()) add_file(context, speech, audio, "audio/wav", wav(made.utterance));
  add_file(context, speech, captions, "text/vtt; charset=utf-8", web_vtt(made.utterance, made.text));
  add_file(context, speech, performance, "application/json", write_performance(made.performance));
  add_file(context, speech, timeline, "application/json", timeline_json(made.utterance, made.text, made.sounds));
  context.store.create_speech(speech, check.record);
  return created(speech);
}

/// What somebody else has said: a timeline, with its sound or without, or a sound, with its text or without.
http::Response create_from_form(Context& context, http::Request& request) {
  const MappedFile mapped(request.body_file->path());
  const auto parts =
      http::parse_multipart(mapped.text(), http::parameter(request.header("Content-Type").value_or(""), "boundary"));
  if (!parts) refuse("malformed-request", "the form cannot be read: " + parts.error().message);
  const auto part = [&](std::string_view name) {
    const auto found = std::find_if(parts->begin(), parts->end(), [&](const auto& one) { return one.name == name; });
    if (found == parts->end()) return std::string_view();
    // A sound that was lost on its way must not become a speech without sound. A page's form in which no file was
    // chosen sends an empty part without the name of a file.
    if (found->content.empty() && !found->file_name.empty())
      refuse("invalid-field", "the file is empty", "/" + std::string(name));
    return found->content;
  };
  voice::TimelineRequest wish;
  wish.timeline = part("timeline");
  wish.sound = part("audio");
  const bool aligned = wish.timeline.empty();
  if (aligned && wish.sound.empty())
    refuse("invalid-field", "the form has neither a part \"timeline\" nor a part \"audio\"", "/timeline");
  http::Request options;
  options.body = std::string(part("options"));
  const auto body = body_object(options);
  refuse_unknown_members(body, body_members::timeline_speech_request);
  wish.text = text_member(body, "text");
  wish.language = text_member(body, "language");
  if (body.contains("format"))
    wish.format = static_cast<TimelineFormat>(choice_member(body, "format", timeline_format_names, 0));
  read_manner(body, wish);
  wish.sound_reader = context.config.sound_reader;
  wish.recognizer = context.config.recognizer;
  if (aligned) {
    if (wish.format) refuse("invalid-field", "is of a timeline, which the form does not have", "/format");
    if (!wish.text.empty()) refuse_without_voice(context);
  }
  // The fingerprint is not that of the raw body, because a retry has another boundary.
  const auto fingerprint = sha256_hex(sha256_hex(options.body) + sha256_hex(wish.timeline) + sha256_hex(wish.sound));
  return create(context, request, body.dump(), fingerprint, [&] {
    const auto slot = take_voice_slot(context);
    const voice::SaidRequest& said = wish;
    auto speech = aligned ? voice::make_speech(context.config.voice, said) : voice::make_speech(wish);
    if (!speech) {
      const Error& error = speech.error();
      if (error.code == ErrorCode::io && error.where == "audio") refuse("voice-failed", error.message);
      const bool voices = error.code == ErrorCode::io || error.where.empty() || error.where == "voice";
      if (voices) refuse("voice-failed", "the voice: " + error.message);
      refuse("invalid-field", error.message, "/" + error.where);
    }
    return *std::move(speech);
  });
}

}  // namespace

http::Response create_speech(Context& context, http::Request& request) {
  if (request.body_file) return create_from_form(context, request);
  refuse_without_voice(context);
  const auto body = body_object(request);
  refuse_unknown_members(body, body_members::speech_request);
  const auto wish = speech_request(body);
  return create(context, request, body.dump(), sha256_hex(request.body), [&] {
    const auto slot = take_voice_slot(context);
    return spoken(voice::make_speech(context.config.voice, wish));
  });
}

http::Response list_voices(Context& context, http::Request&) {
  if (context.config.voice.command.empty()) return json_response(200, answer::Voices{});
  auto names = context.known_voices->at(KnownVoices::Clock::now());
  if (!names) {
    const auto slot = take_voice_slot(context);
    auto listed = voice::list_voices(context.config.voice);
    if (!listed) refuse("voice-failed", "the voice: " + listed.error().message);
    context.known_voices->keep(*listed, KnownVoices::Clock::now());
    names = *std::move(listed);
  }
  answer::Voices page;
  for (const auto& name : *names)
    page.voices.push_back(
        {.voice = name.voice,
         .label = name.label,
         .language = name.language,
         .quality = std::string(language_quality_names[static_cast<std::size_t>(quality_of(name.language))])});
  return json_response(200, page);
}

http::Response list_speeches(Context& context, http::Request& request) {
  const auto limit = page_size(request);
  auto records = context.store.speeches(request.query_value("after").value_or(""), limit + 1);
  if (!records) refuse("invalid-argument", "there is no such speech", "?after");
  answer::Speeches page{.speeches = {}, .next = cut_to_page(*records, limit)};
  for (const auto& record : *records) page.speeches.push_back(speech_answer(record));
  return json_response(200, page);
}

http::Response get_speech(Context& context, http::Request& request) {
  return json_response(200, speech_answer(speech_of(context, request)));
}

http::Response delete_speech(Context& context, http::Request& request) {
  const auto& id = request.params.at("speech");
  const std::unique_lock alone(context.blobs.references());
  const auto orphans = context.pending.with_reserve([&] { return context.store.remove_speech(id); });
  if (!orphans) refuse("not-found", "there is no speech " + id);
  for (const auto& hash : *orphans) context.blobs.remove(hash);
  http::Response response;
  response.status = 204;
  return response;
}

http::Response get_speech_audio(Context& context, http::Request& request) {
  return speech_file(context, request, audio);
}
http::Response get_speech_timeline(Context& context, http::Request& request) {
  return speech_file(context, request, timeline);
}
http::Response get_speech_performance(Context& context, http::Request& request) {
  return speech_file(context, request, performance);
}
http::Response get_speech_captions(Context& context, http::Request& request) {
  return speech_file(context, request, captions);
}

http::Response speak_into_stream(Context& context, http::Request& request) {
  const auto info = context.hub.info(request.params.at("stream"));
  if (!info) refuse("not-found", "there is no stream " + request.params.at("stream"));
  const auto steps = scaled_quantizers(info->settings.quantizer_scale);
  const auto body = body_object(request);
  refuse_unknown_members(body, body_members::stream_speech);
  const bool take_over = flag_member(body, "take_over");
  if (!body.contains("speech")) {
    refuse_without_voice(context);
    auto place = take_speaker(context);
    auto first = [&] {
      const auto slot = take_voice_slot(context);
      return LiveSpeech::of_text(spoken(voice::SpeechParts::read(context.config.voice, speech_request(body))), steps);
    }();
    return play(context, request, spoken(std::move(first)), std::move(place), take_over);
  }
  for (const auto& member : body.items())
    if (member.key() != "speech" && member.key() != "take_over")
      refuse("invalid-field", "a stored speech has it: give only one of the two", "/" + member.key());
  const auto id = checked_text(body["speech"], max_name_bytes, "/speech");
  const auto& rights = asking_of(request).rights;
  const auto speech = context.store.speech(id);
  if (rights.limited() && (!speech || speech->owner != rights.token))
    refuse("forbidden", "the token may not read this speech", "/speech");
  if (!speech) refuse("invalid-field", "there is no speech " + id, "/speech");
  auto place = take_speaker(context);
  const MappedFile file(whole_file(context, *speech, performance));
  const auto script = read_performance(file.text());
  if (!script) refuse("internal", "the speech cannot be read: " + script.error().message);
  Recording sound;
  if (has_file(*speech, audio)) {
    const MappedFile audio_file(whole_file(context, *speech, audio));
    auto recording = read_wav(audio_file.text());
    if (!recording) refuse("internal", "the sound cannot be read: " + recording.error().message);
    sound = *std::move(recording);
  }
  auto live = LiveSpeech::of_speech(*script, sound, texts_of(context, *speech, *script), steps);
  if (!live) refuse("internal", "the speech cannot be played: " + live.error().message);
  return play(context, request, *std::move(live), std::move(place), take_over);
}

}  // namespace semblante::api

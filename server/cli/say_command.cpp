#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <memory>
#include <ostream>

#include <CLI/CLI.hpp>

#include "core/speech/marked_text.h"
#include "core/speech/sounds.h"
#include "core/speech/speech.h"
#include "core/speech/wav.h"
#include "protocol/cpp/performance_document.h"
#include "server/cli/clip_output.h"
#include "server/cli/command_failure.h"
#include "server/cli/commands.h"
#include "server/cli/face_formats.h"
#include "server/cli/files.h"
#include "server/cli/real_range.h"
#include "server/voice/speech_maker.h"

namespace semblante {
namespace {

struct SayCommand {
  voice::VoiceRequest request;
  std::string text, program, recognizer, out, audio, captions, emotion, style = "normal", timeline, timeline_format,
                                                                        audio_in, sound;
  double intensity = 1.0, fps = 30.0;
  std::uint32_t seed = 0;
  ClipOutput clip;
  bool quiet = false, list_voices = false;
};

/// "-" is standard input.
std::string text_of(const SayCommand& options) {
  if (options.text != "-") return options.text;
  std::string text(voice::max_text_bytes + 1, '\0');
  std::cin.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(std::cin.gcount()));
  return text;
}

void write_face(SayCommand& options, const PerformanceScript& script, std::vector<std::string>& warnings) {
  const std::string document = write_performance(script);
  if (std::filesystem::path(options.out).extension() == ".json") {
    write_file(options.out, [&document](std::ostream& out) { out << document; });
    return;
  }
  FaceReading reading;
  reading.rate = options.fps;
  const auto sequence = read_performance_faces(document, reading);
  if (!sequence) fail("say", sequence.error());
  if (is_clip(options.out, "")) {
    options.clip.head.quiet = options.quiet;
    for (std::string& warning : write_clip(options.clip, *sequence, script.name, options.out))
      warnings.push_back(std::move(warning));
    return;
  }
  const std::string text = write_faces(*sequence, options.out, "", {});
  write_file(options.out, [&text](std::ostream& out) { out << text; });
}

std::string bytes_of(const std::string& path, std::uint64_t most) {
  if (path.empty()) return {};
  auto bytes = read_file(path, most);
  return {bytes.begin(), bytes.end()};
}

template <class Request>
void read_manner(const SayCommand& options, Request& request) {
  request.expression = static_cast<std::uint8_t>(std::max(0, expression_of(options.emotion)));
  request.intensity = options.intensity;
  request.face.name = "speech";
  request.face.seed = options.seed;
  request.face.style = static_cast<SpeechStyle>(
      std::find(speech_style_names.begin(), speech_style_names.end(), options.style) - speech_style_names.begin());
}

voice::VoiceProgram program_of(const SayCommand& options) {
  voice::VoiceProgram program;
  program.command = {options.program.empty() ? voice::installed_voice() : options.program};
  return program;
}

/// A line for each: its name, its language, how well that is said, and the voice's own description, between tabs.
void print_voices(const SayCommand& options) {
  const auto names = voice::list_voices(program_of(options));
  if (!names) fail("say", names.error());
  for (const voice::VoiceName& name : *names)
    if (options.request.language.empty() || name.language.starts_with(options.request.language))
      std::cout << name.voice << "\t" << name.language << "\t"
                << language_quality_names[static_cast<std::size_t>(quality_of(name.language))] << "\t" << name.label
                << "\n";
}

Result<voice::Speech> speak(const SayCommand& options) {
  voice::SpeechRequest request;
  request.voice = options.request;
  request.voice.text = text_of(options);
  read_manner(options, request);
  return voice::make_speech(program_of(options), request);
}

/// Of --timeline, else of --sound.
Result<voice::Speech> read_said(const SayCommand& options) {
  constexpr std::uint64_t most_sound_bytes = std::uint64_t{1} << 30U;
  const std::string timeline = bytes_of(options.timeline, max_timeline_bytes);
  const std::string sound = bytes_of(options.timeline.empty() ? options.sound : options.audio_in, most_sound_bytes);
  voice::TimelineRequest request;
  request.timeline = timeline;
  request.sound = sound;
  request.sound_reader.command = {voice::installed_sound_reader()};
  request.recognizer = voice::recognizer_at(options.recognizer);
  if (!options.timeline_format.empty())
    request.format = static_cast<TimelineFormat>(
        std::find(timeline_format_names.begin(), timeline_format_names.end(), options.timeline_format) -
        timeline_format_names.begin());
  request.text = text_of(options);
  request.language = options.request.language;
  read_manner(options, request);
  const voice::SaidRequest& said = request;
  return options.timeline.empty() ? voice::make_speech(program_of(options), said) : voice::make_speech(request);
}

void run(SayCommand& options) {
  if (options.list_voices) return print_voices(options);
  const bool heard = !options.sound.empty() && options.text.empty();
  if (heard && options.request.language.empty()) options.request.language = "und";
  if (options.request.language.empty()) throw CommandFailure(CommandFailure::bad_input, "say: --language is required");
  if (options.out.empty() && options.audio.empty() && options.captions.empty())
    throw CommandFailure(CommandFailure::bad_input, "say: give --out, --audio or --captions: nothing would be written");
  if (options.timeline.empty() && options.sound.empty() && options.text.empty())
    throw CommandFailure(CommandFailure::bad_input, "say: give a text, --timeline or --sound");
  const bool said = !options.timeline.empty() || !options.sound.empty();
  const auto speech = said ? read_said(options) : speak(options);
  if (!speech) fail("say", speech.error());

  std::vector<std::string> warnings = speech->warnings;
  if (!options.out.empty()) write_face(options, speech->performance, warnings);
  const auto write = [](const std::string& path, const std::string& bytes) {
    if (!path.empty()) write_file(path, [&bytes](std::ostream& out) { out << bytes; });
  };
  if (!options.audio.empty() && speech->utterance.samples.empty())
    throw CommandFailure(CommandFailure::bad_input, "say: --audio: a timeline without --audio-in has no sound");
  write(options.audio, wav(speech->utterance));
  write(options.captions, web_vtt(speech->utterance, speech->text));
  print_warnings(warnings, options.quiet);
}

}  // namespace

void add_say_command(CLI::App& app, const std::string& sample_head) {
  auto options = std::make_shared<SayCommand>();
  CLI::App* const command = app.add_subcommand(
      "say",
      "Say a text: the face as a performance (.json) or an animated head (.glb), the sound (WAV), the words with their "
      "times (WebVTT), all on one clock. Emoticons, emoji and spans as [joy]...[/joy] (joy, sadness, anger, fear, "
      "disgust, surprise; [joy 0.5] is half as strong) or <emotion name=\"joy\">...</emotion> give it an emotion. A "
      "voice makes the sound: "
      "semblante-voice-espeak, or any program that speaks its protocol (server/voice/README.md).");
  command->add_option("TEXT", options->text,
                      "What to say; - reads it from standard input. With --timeline or --sound it may be left out");
  command->add_option("--language", options->request.language, "Language of the text; mouths are made for pt-BR and en")
      ->envname("SEMBLANTE_LANGUAGE");
  command->add_option("--voice", options->request.voice, "Name of a voice that the voice program knows")
      ->envname("SEMBLANTE_VOICE");
  command
      ->add_option("--voice-program", options->program,
                   "Program that speaks; left out: semblante-voice-espeak beside this one")
      ->envname("SEMBLANTE_VOICE_PROGRAM");
  CLI::Option* const timeline =
      command
          ->add_option(
              "--timeline", options->timeline,
              "What another voice has said when, in place of a voice: visemes of Azure, speech marks of Amazon "
              "Polly, Rhubarb's TSV, XML or JSON, an answer of HeadTTS, lines of begin, end (s) and a phoneme "
              "(IPA) between tabs, or a timeline of the server")
          ->envname("SEMBLANTE_TIMELINE");
  command->add_option("--timeline-format", options->timeline_format, "Left out: what the file looks like")
      ->check(CLI::IsMember(std::vector<std::string>(timeline_format_names.begin(), timeline_format_names.end())))
      ->needs(timeline)
      ->envname("SEMBLANTE_TIMELINE_FORMAT");
  command
      ->add_option(
          "--sound", options->sound,
          "A recording in place of a voice: WAV, or what semblante-sound beside this program reads (FLAC, Ogg with "
          "Vorbis or Opus, MP3). With its text the voice says when in it is said what; without, a recognizer of "
          "--language hears words in it, or, without one, visemes are heard, in any language, without captions")
      ->excludes(timeline)
      ->envname("SEMBLANTE_SOUND");
  command
      ->add_option("--recognizer-program", options->recognizer,
                   "Program that hears words in --sound without a text; left out: semblante-recognizer-pocketsphinx "
                   "beside this one, for English; none: no words")
      ->envname("SEMBLANTE_RECOGNIZER_PROGRAM");
  command->add_option("--audio-in", options->audio_in, "The sound of --timeline, a file as of --sound")
      ->needs(timeline)
      ->envname("SEMBLANTE_AUDIO_IN");
  command->add_flag(
      "--list-voices", options->list_voices,
      "Print the voices of the voice program, of --language if it is given: name, language, quality of its "
      "mouths (measured, table of a relative; english: the chart of IPA), description");
  command
      ->add_flag("--ssml", options->request.ssml,
                 "The text is SSML: break, prosody, mark, say-as, emphasis; <emotion name=\"joy\"> and <prosody "
                 "emotion=\"joy\"> are expressions")
      ->envname("SEMBLANTE_SSML");
  for (auto [name, value, what] :
       {std::tuple{"--rate", &options->request.rate, "Times the usual speed of the voice"},
        std::tuple{"--pitch", &options->request.pitch, "Times the usual pitch of the voice"}})
    command->add_option(name, *value, what)
        ->check(real_range(voice::least_factor, voice::most_factor))
        ->capture_default_str();
  command->add_option("--emotion", options->emotion, "Of the whole text")
      ->check(CLI::IsMember(emotion_names()))
      ->envname("SEMBLANTE_EMOTION");
  command->add_option("--intensity", options->intensity, "Of --emotion")
      ->check(real_range(0.0, 1.0))
      ->capture_default_str()
      ->envname("SEMBLANTE_INTENSITY");
  command->add_option("--style", options->style, "How much brows and head take part")
      ->check(CLI::IsMember(std::vector<std::string>(speech_style_names.begin(), speech_style_names.end())))
      ->capture_default_str()
      ->envname("SEMBLANTE_STYLE");
  command->add_option("--seed", options->seed, "Of blinks, nods and glances: another number, another person")
      ->capture_default_str()
      ->envname("SEMBLANTE_SEED");
  command
      ->add_option("--out", options->out,
                   "The face: .json a performance, .glb a head that speaks, or a format of `convert`, by its name")
      ->envname("SEMBLANTE_OUT");
  command->add_option("--audio", options->audio, "The sound, a WAV file")->envname("SEMBLANTE_AUDIO");
  command->add_option("--captions", options->captions, "The words with their times, a WebVTT file")
      ->envname("SEMBLANTE_CAPTIONS");
  command->add_option("--fps", options->fps, "Frames a second of --out, unless it is a performance")
      ->check(real_range(1.0, 120.0))
      ->capture_default_str()
      ->envname("SEMBLANTE_FPS");
  add_clip_options(*command, options->clip);
  command->add_flag("--quiet", options->quiet, "No warnings")->envname("SEMBLANTE_QUIET");
  command->callback([options, sample_head, command] {
    HeadOptions& head = options->clip.head;
    if (head.model_path == "sample" && !std::filesystem::exists("sample")) {
      if (sample_head.empty())
        throw CommandFailure(CommandFailure::bad_input, "say: --model sample: the sample head is not installed");
      head.model_path = sample_head;
      head.feature_points_path = std::filesystem::path(sample_head).replace_extension(".fps.json").string();
    }
    // Weights of the paper close lips less well: a head that speaks has smooth ones.
    if (command->get_option("--weights")->count() == 0) head.weights = "smooth";
    run(*options);
  });
}

}  // namespace semblante

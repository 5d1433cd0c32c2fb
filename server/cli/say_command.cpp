#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <memory>
#include <ostream>

#include <CLI/CLI.hpp>

#include "core/speech/marked_text.h"
#include "core/speech/speech.h"
#include "protocol/cpp/performance_document.h"
#include "server/cli/clip_output.h"
#include "server/cli/command_failure.h"
#include "server/cli/commands.h"
#include "server/cli/face_formats.h"
#include "server/cli/files.h"
#include "server/voice/speech_maker.h"

namespace semblante {
namespace {

struct SayCommand {
  voice::VoiceRequest request;
  std::string text, program, out, audio, captions, emotion, style = "normal";
  double intensity = 1.0, fps = 30.0;
  std::uint32_t seed = 0;
  ClipOutput clip;
  bool quiet = false;
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

void run(SayCommand& options) {
  if (options.out.empty() && options.audio.empty() && options.captions.empty())
    throw CommandFailure(CommandFailure::bad_input, "say: give --out, --audio or --captions: nothing would be written");
  voice::SpeechRequest request;
  request.voice = options.request;
  request.voice.text = text_of(options);
  request.expression = static_cast<std::uint8_t>(std::max(0, expression_of(options.emotion)));
  request.intensity = options.intensity;
  request.face.name = "speech";
  request.face.seed = options.seed;
  request.face.style = static_cast<SpeechStyle>(
      std::find(speech_style_names.begin(), speech_style_names.end(), options.style) - speech_style_names.begin());
  voice::VoiceProgram program;
  program.command = {options.program.empty() ? voice::installed_voice() : options.program};
  const auto speech = voice::make_speech(program, request);
  if (!speech) fail("say", speech.error());

  std::vector<std::string> warnings = speech->warnings;
  if (!options.out.empty()) write_face(options, speech->performance, warnings);
  const auto write = [](const std::string& path, const std::string& bytes) {
    if (!path.empty()) write_file(path, [&bytes](std::ostream& out) { out << bytes; });
  };
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
      "disgust, surprise; [joy 0.5] is half as strong) give it an emotion. A voice makes the sound: "
      "semblante-voice-espeak, or any program that speaks its protocol (server/voice/README.md).");
  command->add_option("TEXT", options->text, "What to say; - reads it from standard input")->required();
  command->add_option("--language", options->request.language, "Language of the text; mouths are made for pt-BR and en")
      ->required()
      ->envname("SEMBLANTE_LANGUAGE");
  command->add_option("--voice", options->request.voice, "Name of a voice that the voice program knows")
      ->envname("SEMBLANTE_VOICE");
  command
      ->add_option("--voice-program", options->program,
                   "Program that speaks; left out: semblante-voice-espeak beside this one")
      ->envname("SEMBLANTE_VOICE_PROGRAM");
  command->add_flag("--ssml", options->request.ssml, "The text is SSML: break, prosody, mark, say-as, emphasis")
      ->envname("SEMBLANTE_SSML");
  for (auto [name, value, what] :
       {std::tuple{"--rate", &options->request.rate, "Times the usual speed of the voice"},
        std::tuple{"--pitch", &options->request.pitch, "Times the usual pitch of the voice"}})
    command->add_option(name, *value, what)
        ->check(CLI::Range(voice::least_factor, voice::most_factor))
        ->capture_default_str();
  command->add_option("--emotion", options->emotion, "Of the whole text")
      ->check(CLI::IsMember(emotion_names()))
      ->envname("SEMBLANTE_EMOTION");
  command->add_option("--intensity", options->intensity, "Of --emotion")
      ->check(CLI::Range(0.0, 1.0))
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
      ->check(CLI::Range(1.0, 120.0))
      ->capture_default_str()
      ->envname("SEMBLANTE_FPS");
  add_clip_options(*command, options->clip);
  command->add_flag("--quiet", options->quiet, "No warnings")->envname("SEMBLANTE_QUIET");
  CLI::Option* const points = command->get_option("--feature-points");
  command->get_option("--model")->remove_needs(points);  // the sample head has its own
  command->callback([options, sample_head, command] {
    HeadOptions& head = options->clip.head;
    if (head.model_path == "sample" && !std::filesystem::exists("sample")) {
      if (sample_head.empty())
        throw CommandFailure(CommandFailure::bad_input, "say: --model sample: the sample head is not installed");
      head.model_path = sample_head;
      head.feature_points_path = std::filesystem::path(sample_head).replace_extension(".fps.json").string();
      // Weights of the paper close lips less well: a head that speaks has smooth ones.
      if (command->get_option("--weights")->count() == 0) head.weights = "smooth";
    }
    if (!head.model_path.empty() && head.feature_points_path.empty())
      throw CommandFailure(CommandFailure::bad_input, "say: --model requires --feature-points");
    run(*options);
  });
}

}  // namespace semblante

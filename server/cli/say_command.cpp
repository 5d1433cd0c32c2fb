#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <memory>
#include <ostream>

#include <CLI/CLI.hpp>

#include "core/speech/loudness.h"
#include "core/speech/marked_text.h"
#include "core/speech/sounds.h"
#include "core/speech/speech.h"
#include "core/types/printable.h"
#include "protocol/cpp/performance_document.h"
#include "server/cli/clip_output.h"
#include "server/cli/command_failure.h"
#include "server/cli/commands.h"
#include "server/cli/face_formats.h"
#include "server/cli/files.h"
#include "server/voice/voice_process.h"

namespace semblante {
namespace {

struct SayCommand {
  voice::VoiceRequest request;
  std::string text, program, out, audio, captions, emotion;
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

MarkedText marked_text(const SayCommand& options, const std::string& text) {
  MarkedText marked;
  if (options.request.ssml) {
    marked.text = text;
  } else {
    auto read = read_marked_text(text);
    if (!read) fail("say", read.error());
    marked = *std::move(read);
  }
  // The whole text; a mark within it is laid over it.
  const auto expression = static_cast<std::uint8_t>(std::max(0, expression_of(options.emotion)));
  if (expression != 0)
    marked.emotions.insert(marked.emotions.begin(), {expression, options.intensity, {0, marked.text.size()}});
  return marked;
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
  // Marks are read before the voice checks the text: it must be text at all.
  voice::VoiceRequest request = options.request;
  request.text = text_of(options);
  if (const auto checked = voice::check(request); !checked) fail("say", checked.error());
  const MarkedText marked = marked_text(options, request.text);
  request.text = marked.text;
  if (!request.ssml) {
    const Prosody prosody = prosody_of(marked);
    request.rate = std::clamp(request.rate * prosody.rate, voice::least_factor, voice::most_factor);
    request.pitch = std::clamp(request.pitch * prosody.pitch, voice::least_factor, voice::most_factor);
  }
  voice::VoiceProgram program;
  program.command = {options.program.empty() ? voice::installed_voice() : options.program};
  auto spoken = voice::speak(program, request);
  if (!spoken) fail("say", spoken.error());
  const Utterance utterance = with_silence(*std::move(spoken), speech_lead_ms, speech_tail_ms);

  std::vector<std::string> warnings;
  if (!has_sound_table(request.language))
    warnings.push_back(printable(request.language) + " has no table of sounds of its own: mouths are those of English");
  if (!options.out.empty()) {
    SpeechOptions speech;
    speech.name = "speech";
    speech.language = request.language;
    speech.seed = options.seed;
    write_face(options, speech_performance(utterance, marked.emotions, speech), warnings);
  }
  if (!options.audio.empty()) {
    const std::string sound = wav(utterance);
    write_file(options.audio, [&sound](std::ostream& out) { out << sound; });
  }
  if (!options.captions.empty()) {
    const std::string captions = web_vtt(utterance, marked.text);
    write_file(options.captions, [&captions](std::ostream& out) { out << captions; });
  }
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

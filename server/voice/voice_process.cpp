#include "server/voice/voice_process.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <optional>
#include <unistd.h>

#include "core/types/printable.h"
#include "server/jobs/error_file.h"
#include "server/jobs/worker_process.h"

namespace semblante::voice {
namespace {

constexpr const char* usual_name = "semblante-voice-espeak";
constexpr const char* sound_reader_name = "semblante-sound";
constexpr const char* recognizer_name = "semblante-recognizer-pocketsphinx";

std::string with_last_words(const std::string& message, const std::string& words) {
  const auto last = words.substr(words.rfind('\n') == std::string::npos ? 0 : words.rfind('\n') + 1);
  return last.empty() ? message : message + ": " + printable(last);
}

bool is_missing(const VoiceProgram& program) { return program.command.empty() || program.command[0].empty(); }

/// Has the program answer to its end. `ended`: it was started and ended by itself, well or not, within its time.
Result<VoiceAnswer> ask(const VoiceProgram& program, std::string_view input, const std::function<bool()>& wanted = {},
                        bool* ended = nullptr) {
  const jobs::ErrorFile errors(program.temporary);
  jobs::WorkerLimits limits;
  limits.memory_bytes = program.memory_bytes;
  limits.cpu_seconds = program.cpu_seconds;
  limits.file_bytes = std::uint64_t{128} << 20U;  // a library of sound may map a file of 64 MiB that it never fills
  VoiceAnswer answer;
  std::optional<Error> fault;
  const auto exit = jobs::run_worker_process(
      program.command, input, errors.path(), std::chrono::seconds(program.wall_seconds),
      [&](std::string_view line) {
        if (fault) return;
        if (const auto taken = answer.take(line); !taken) fault = taken.error();
      },
      [&] { return fault || (wanted && !wanted()) ? jobs::Wish::stop : jobs::Wish::go_on; }, limits);
  if (!exit) return exit.error();
  using Kind = jobs::WorkerExit::Kind;
  if (ended != nullptr) *ended = exit->kind != Kind::timed_out;
  if (fault) return *fault;
  if (exit->kind == Kind::stopped) return Error{ErrorCode::cancelled, "voice", "is not wanted any more"};
  if (exit->kind == Kind::timed_out)
    return Error{ErrorCode::io, "voice", "took longer than " + std::to_string(program.wall_seconds) + " s"};
  if (exit->kind == Kind::signalled)
    return Error{
        ErrorCode::io, "voice",
        with_last_words(std::string("was ended by the signal \"") + ::strsignal(exit->code) + "\"", exit->last_words)};
  if (exit->code != 0)
    return Error{ErrorCode::io, "voice",
                 with_last_words("failed with exit code " + std::to_string(exit->code), exit->last_words)};
  return answer;
}

Result<VoiceAnswer> ask(const VoiceProgram& voice, const VoiceRequest& request,
                        const std::function<bool()>& wanted = {}) {
  if (is_missing(voice))
    return Error{ErrorCode::missing, "voice", "there is no voice: " + std::string(usual_name) + " is not installed"};
  return ask(voice, to_json(request), wanted);
}

/// The program beside this one; empty if there is none.
std::string installed(const char* name) {
  const auto path = std::filesystem::path(jobs::own_executable()).parent_path() / name;
  return ::access(path.c_str(), X_OK) == 0 ? path.string() : std::string();
}

}  // namespace

std::string installed_voice() { return installed(usual_name); }
std::string installed_sound_reader() { return installed(sound_reader_name); }

VoiceProgram recognizer_at(const std::string& path) {
  VoiceProgram program;
  program.command = {path == "none" ? "" : path.empty() ? installed(recognizer_name) : path};
  // A library of linear algebra that pocketsphinx is linked with reserves addresses for each processor.
  program.memory_bytes = std::uint64_t{4} << 30U;
  return program;
}

Result<Utterance> speak(const VoiceProgram& program, const VoiceRequest& request, const std::function<bool()>& wanted) {
  if (const auto checked = check(request); !checked) return checked.error();
  auto answer = ask(program, request, wanted);
  if (!answer) return answer.error();
  return (*std::move(answer)).finish();
}

Result<std::vector<VoiceName>> list_voices(const VoiceProgram& program) {
  VoiceRequest request;
  request.list = true;
  auto answer = ask(program, request);
  if (!answer) return answer.error();
  return (*std::move(answer)).finish_list();
}

Result<Heard> recognize(const VoiceProgram& program, const Recording& sound, std::string_view language) {
  if (const auto checked = check_language(language); !checked) return checked.error();
  if (is_missing(program)) return Error{ErrorCode::missing, "", "there is no recognizer"};
  constexpr std::size_t samples_a_line = 16'384;
  std::string input = header_line("recording", sound.sample_rate, language);
  for (std::size_t at = 0; at < sound.samples.size(); at += samples_a_line)
    input += audio_line(std::span(sound.samples).subspan(at, std::min(samples_a_line, sound.samples.size() - at)));
  input += end_line();
  auto answer = ask(program, input);
  if (!answer) return answer.error();
  return (*std::move(answer)).finish_heard(1000.0 * static_cast<double>(sound.samples.size()) / sound.sample_rate);
}

Result<Recording> read_sound(const VoiceProgram& reader, std::string_view file) {
  if (file.starts_with("RIFF")) return read_wav(file);
  if (file.size() > max_sound_file_bytes)
    return Error{ErrorCode::too_large, "", "is longer than " + std::to_string(max_sound_file_bytes >> 20U) + " MiB"};
  if (is_missing(reader))
    return Error{ErrorCode::unsupported, "",
                 "is no WAV file, and " + std::string(sound_reader_name) + ", which reads others, is not installed"};
  bool ended = false;
  auto answer = ask(reader, file, {}, &ended);
  // A reader that crashes or uses up its processor time does so by the file; on a busy machine any file takes long.
  if (!answer && !ended) return Error{ErrorCode::io, "", std::string(sound_reader_name) + " " + answer.error().message};
  if (!answer) return Error{ErrorCode::malformed, "", answer.error().message};
  auto sound = (*std::move(answer)).finish();
  if (!sound) return Error{ErrorCode::malformed, "", sound.error().message};
  return Recording{sound->sample_rate, std::move(sound->samples)};
}

}  // namespace semblante::voice

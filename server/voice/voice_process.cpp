#include "server/voice/voice_process.h"

#include <chrono>
#include <cstring>
#include <filesystem>
#include <optional>
#include <unistd.h>

#include "core/types/printable.h"
#include "server/jobs/worker_process.h"

namespace semblante::voice {
namespace {

constexpr const char* usual_name = "semblante-voice-espeak";
constexpr const char* sound_reader_name = "semblante-sound";

/// What the voice writes to standard error, for as long as it runs.
class ErrorFile {
 public:
  explicit ErrorFile(const std::filesystem::path& folder) {
    std::string name =
        ((folder.empty() ? std::filesystem::temp_directory_path() : folder) / "semblante-voice-XXXXXX").string();
    const int file = ::mkstemp(name.data());
    if (file < 0) return;
    ::close(file);
    path_ = name;
  }
  ~ErrorFile() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  ErrorFile(const ErrorFile&) = delete;
  ErrorFile& operator=(const ErrorFile&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string with_last_words(std::string message, const std::string& words) {
  const auto last = words.substr(words.rfind('\n') == std::string::npos ? 0 : words.rfind('\n') + 1);
  return last.empty() ? message : message + ": " + printable(last);
}

bool is_missing(const VoiceProgram& program) { return program.command.empty() || program.command[0].empty(); }

/// Has the program answer to its end.
Result<VoiceAnswer> ask(const VoiceProgram& program, std::string_view input, const std::function<bool()>& wanted = {}) {
  const ErrorFile errors(program.temporary);
  if (errors.path().empty()) return Error{ErrorCode::io, "", "cannot make a temporary file"};

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
  if (fault) return *fault;
  using Kind = jobs::WorkerExit::Kind;
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

Result<Recording> read_sound(const VoiceProgram& reader, std::string_view file) {
  if (file.starts_with("RIFF")) return read_wav(file);
  if (file.size() > max_sound_file_bytes)
    return Error{ErrorCode::too_large, "", "is longer than " + std::to_string(max_sound_file_bytes >> 20U) + " MiB"};
  if (is_missing(reader))
    return Error{ErrorCode::unsupported, "",
                 "is no WAV file, and " + std::string(sound_reader_name) + ", which reads others, is not installed"};
  auto answer = ask(reader, file);
  // A reader that crashes or reaches a limit does so by the file.
  if (!answer) return Error{ErrorCode::malformed, "", answer.error().message};
  auto sound = (*std::move(answer)).finish();
  if (!sound) return Error{ErrorCode::malformed, "", sound.error().message};
  return Recording{sound->sample_rate, std::move(sound->samples)};
}

}  // namespace semblante::voice

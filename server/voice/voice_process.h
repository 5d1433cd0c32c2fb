#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/speech/utterance.h"
#include "core/speech/wav.h"
#include "core/types/result.h"
#include "server/voice/voice_protocol.h"

namespace semblante::voice {

/// How a voice is started.
struct VoiceProgram {
  std::vector<std::string> command;  ///< the program's path and its arguments
  std::uint64_t memory_bytes = std::uint64_t{1} << 30U;
  std::uint64_t cpu_seconds = 60;
  std::uint64_t wall_seconds = 120;
  std::filesystem::path temporary = {};  ///< folder of the file that receives its standard error; empty: the system's
};

/// The voice that is installed beside this program, or built beside it; empty if there is none.
std::string installed_voice();
/// The same of semblante-sound (sound/README.md), which reads sound files.
std::string installed_sound_reader();
/// The recognizer at this path; of an empty one semblante-recognizer-pocketsphinx (pocketsphinx/README.md) beside this
/// program, if it is there; of "none" none.
VoiceProgram recognizer_at(const std::string& path);

/// Starts the voice, with its limits in force before it gets the request, and reads its answer. A voice that breaks the
/// protocol is killed at the first wrong line. Blocks until the process has ended. Errors: those of check() and
/// VoiceAnswer; `io`: it cannot be started, crashed, or reached a limit, with the end of what it wrote to standard
/// error; `cancelled`: `wanted`, asked a few times per second, was false, and the voice was killed. Throws
/// store::StoreError when its temporary file cannot be made.
Result<Utterance> speak(const VoiceProgram& program, const VoiceRequest& request,
                        const std::function<bool()>& wanted = {});

/// The voices that the program knows. Errors as those of speak().
Result<std::vector<VoiceName>> list_voices(const VoiceProgram& program);

/// What the program hears in a sound of this language. Errors as those of speak(): `unsupported` with `where`
/// "language" if it does not know the language.
Result<Heard> recognize(const VoiceProgram& program, const Recording& sound, std::string_view language);

/// The sound of a file, its channels mixed: of WAV, read here, or of what `reader` knows (FLAC, Ogg with Vorbis or
/// Opus, MP3). Errors: of the file; `io`: the reader cannot be started, or did not come to its end in time.
Result<Recording> read_sound(const VoiceProgram& reader, std::string_view file);

}  // namespace semblante::voice

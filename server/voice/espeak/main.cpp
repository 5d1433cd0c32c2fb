// A voice: reads a request, writes sound and what is said when (server/voice/README.md), by libespeak-ng.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include <espeak-ng/speak_lib.h>
#include <sys/resource.h>

#include "core/types/letter_case.h"
#include "server/jobs/isolation.h"
#include "server/voice/espeak/bounded_words.h"
#include "server/voice/espeak/dictionaries.h"
#include "server/voice/espeak/phoneme_trace.h"
#include "server/voice/program.h"
#include "server/voice/voice_protocol.h"

namespace semblante::voice {
namespace {

constexpr int usual_words_per_minute = 160;
constexpr int usual_pitch = 50;
constexpr std::size_t samples_a_line = 16'384;

/// What the callback of libespeak-ng, which has no argument of ours, works with.
struct Speaking {
  PhonemeTrace* trace = nullptr;
  std::size_t samples = 0, most_samples = 0;
  TextRange last_word;
  bool too_long = false, broken = false;
};
Speaking speaking;  // NOLINT: see above

void say_event(const espeak_EVENT& event) {
  const double time = std::max(0, event.audio_position);
  const auto first = static_cast<std::size_t>(std::max(1, event.text_position) - 1);
  switch (event.type) {
    case espeakEVENT_PHONEME: {
      const std::string symbol(event.id.string, ::strnlen(event.id.string, sizeof event.id.string));
      if (symbol.starts_with('(')) break;  // the name of the language that the next phonemes are of
      say(line_of(SpokenPhoneme{time, symbol, speaking.trace->stress_of(symbol)}));
      break;
    }
    case espeakEVENT_WORD:
      // A word that is spelled comes again with each of its letters.
      if (const TextRange word = {first, static_cast<std::size_t>(std::max(0, event.length))};
          word.count > 0 && !(word == speaking.last_word)) {
        say(line_of(SpokenWord{time, word}));
        speaking.last_word = word;
      }
      break;
    case espeakEVENT_SENTENCE:
      say(line_of(SpokenSentence{time, first}));
      break;
    case espeakEVENT_MARK:
      say(line_of(SpokenMark{time, event.id.name != nullptr ? event.id.name : ""}));
      break;
    default:
      break;
  }
}

/// 1 stops the synthesis.
int take(short* samples, int count, espeak_EVENT* events) {
  for (; events->type != espeakEVENT_LIST_TERMINATED; ++events) {
    if (events->audio_position > max_seconds * 1000.0) {  // it comes before its samples
      speaking.too_long = true;
      return 1;
    }
    say_event(*events);
  }
  for (std::size_t at = 0; samples != nullptr && at < static_cast<std::size_t>(std::max(0, count));) {
    const std::size_t here = std::min(samples_a_line, static_cast<std::size_t>(count) - at);
    if (speaking.samples + here > speaking.most_samples) {
      speaking.too_long = true;
      return 1;
    }
    say(audio_line({samples + at, here}));
    speaking.samples += here;
    at += here;
  }
  speaking.broken = !std::cout;
  return speaking.broken ? 1 : 0;
}

/// "pt-BR" -> "pt-br"; English without a country is American.
bool choose_voice(const VoiceRequest& request) {
  if (!request.voice.empty()) return espeak_SetVoiceByName(request.voice.c_str()) == EE_OK;
  std::string name = lower_case(request.language);
  if (name == "en") name = "en-us";
  if (name == "pt") name = "pt-br";
  if (espeak_SetVoiceByName(name.c_str()) == EE_OK) return true;
  return espeak_SetVoiceByName(name.substr(0, name.find('-')).c_str()) == EE_OK;
}

/// libespeak-ng connects to a sound server although it does not use it; this address keeps it from finding one.
void use_no_sound_server() { ::setenv("PULSE_SERVER", "unix:/nonexistent", 1); }

/// After this call, this process and the thread that the library has started can only compute and write to the pipe.
/// Returns what failed; empty if nothing did.
std::string isolate() {
  const rlimit none{0, 0};
  if (::setrlimit(RLIMIT_NOFILE, &none) != 0) return "cannot forbid itself to open files";
  const auto isolated = jobs::isolate_this_process({}, {.highest_landlock = 0});
  return isolated ? "" : isolated.error().message;
}

/// "pt-br" -> "pt-BR": two letters after the first part are a country. The library's "pt" is Portugal's; a request for
/// "pt" gets Brazil's (choose_voice()).
std::string as_tag(std::string language) {
  if (language == "pt") return "pt-PT";
  const std::size_t dash = language.find('-');
  if (dash != std::string::npos &&
      (language.size() == dash + 3 || (language.size() > dash + 3 && language[dash + 3] == '-')))
    for (std::size_t i = dash + 1; i < dash + 3; ++i)
      language[i] = static_cast<char>(std::toupper(static_cast<unsigned char>(language[i])));
  return language;
}

/// The library's voices by the names by which it finds them, and each with other throats (its "variants").
int list_voices(int rate) {
  constexpr std::array<const char*, 3> variants = {"f2", "f4", "m3"};
  say(header_line("espeak-ng", static_cast<std::uint32_t>(rate)));
  const espeak_VOICE** const known = espeak_ListVoices(nullptr);
  std::vector<VoiceName> names;
  for (const espeak_VOICE** voice = known; voice != nullptr && *voice != nullptr; ++voice) {
    // A byte of priority, then the tag.
    const std::string language =
        (*voice)->languages != nullptr && (*voice)->languages[0] != 0 ? (*voice)->languages + 1 : "";
    const std::string file = (*voice)->identifier != nullptr ? (*voice)->identifier : "";
    names.push_back(
        {file.substr(file.rfind('/') + 1), (*voice)->name != nullptr ? (*voice)->name : "", as_tag(language)});
  }
  for (const VoiceName& name : names) {
    if (espeak_SetVoiceByName(name.voice.c_str()) != EE_OK) continue;
    say(line_of(name));
    for (const char* const variant : variants)
      say(line_of(VoiceName{name.voice + "+" + variant, name.label + ", " + variant, name.language}));
  }
  return finish_answer();
}

int run() {
  std::string text(max_request_bytes + 1, '\0');
  std::cin.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(std::cin.gcount()));
  const auto request = request_from_json(text);
  if (!request) return refuse("the request: " + request.error().where + ": " + request.error().message);

  PhonemeTrace trace;
  if (trace.stream() == nullptr) return refuse("there is not enough memory");
  use_no_sound_server();
  const int rate =
      espeak_Initialize(AUDIO_OUTPUT_SYNCHRONOUS, 0, nullptr,
                        espeakINITIALIZE_PHONEME_EVENTS | espeakINITIALIZE_PHONEME_IPA | espeakINITIALIZE_DONT_EXIT);
  if (rate <= 0) return refuse("espeak-ng finds no data: is espeak-ng-data installed?");
  if (request->list) return list_voices(rate);
  if (!choose_voice(*request))
    return request->voice.empty() ? refuse("there is no voice for " + request->language, "language")
                                  : refuse("there is no voice " + request->voice, "voice");
  espeak_SetParameter(espeakRATE, static_cast<int>(usual_words_per_minute * request->rate), 0);
  espeak_SetParameter(espeakPITCH, std::min(99, static_cast<int>(usual_pitch * request->pitch)), 0);
  espeak_SetPhonemeTrace(espeakPHONEMES_SHOW | espeakPHONEMES_IPA | '_' << 8, trace.stream());
  espeak_SetSynthCallback(take);
  speaking.trace = &trace;
  speaking.most_samples = static_cast<std::size_t>(max_seconds * rate);
  const char* data = nullptr;
  const std::string name = std::string("espeak-ng ") + espeak_Info(&data);
  keep_dictionaries(data);
  // The text is a stranger's: from here on the library reads it.
  if (const auto fault = isolate(); !fault.empty()) return refuse(fault);

  say(header_line(name, static_cast<std::uint32_t>(rate)));
  const unsigned flags = espeakCHARS_UTF8 | espeakENDPAUSE | (request->ssml ? espeakSSML : 0U);
  const std::string said = with_bounded_words(request->text, request->ssml);
  const auto code = espeak_Synth(said.c_str(), said.size() + 1, 0, POS_CHARACTER, 0, flags, nullptr, nullptr);
  if (speaking.too_long) return refuse("the sound is longer than " + std::to_string(int(max_seconds)) + " s", "text");
  if (code != EE_OK || speaking.broken) return refuse("espeak-ng failed with code " + std::to_string(code));
  return finish_answer();
}

}  // namespace
}  // namespace semblante::voice

int main() { return semblante::voice::run_program(semblante::voice::run); }

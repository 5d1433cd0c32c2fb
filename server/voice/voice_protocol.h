#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/speech/utterance.h"
#include "core/types/result.h"

namespace semblante::voice {

// The protocol between Semblante and a voice: README.md.
inline constexpr int protocol_version = 1;
inline constexpr std::size_t max_text_bytes = max_utterance_text_bytes;
inline constexpr std::size_t max_request_bytes = 160'000;  ///< every byte of the text escaped as six, and the rest
inline constexpr std::size_t max_line_bytes = 65'536;      ///< of an answer
inline constexpr std::size_t max_events = 200'000;         ///< of all kinds together
inline constexpr std::size_t max_sound_file_bytes = std::size_t{256} << 20U;  ///< read by semblante-sound
inline constexpr double max_seconds = max_speech_seconds;                     ///< of sound
inline constexpr std::size_t max_symbol_bytes = 32;
inline constexpr std::size_t max_name_bytes = 200;
inline constexpr double least_factor = 0.5, most_factor = 2.0;  ///< of rate and pitch

struct VoiceRequest {
  std::string text;      ///< UTF-8 without control characters except tab and newline
  bool ssml = false;     ///< the text is a document of SSML
  std::string language;  ///< BCP 47: "pt-BR"
  std::string voice;     ///< a name that the voice program knows; empty: its own choice
  double rate = 1.0;     ///< times the usual speed
  double pitch = 1.0;    ///< times the usual pitch
  bool list = false;     ///< it asks which voices there are; the rest means nothing
};

/// One that a voice program knows.
struct VoiceName {
  std::string voice;     ///< for VoiceRequest::voice
  std::string label;     ///< for people
  std::string language;  ///< BCP 47
};
inline constexpr std::size_t max_voices = 2'000;

/// Checks what the request must be before any voice sees it. Errors name the member.
Status check(const VoiceRequest& request);
Status check_text(std::string_view text);
Status check_language(std::string_view language);

std::string to_json(const VoiceRequest& request);
/// Reads and checks the request, as a voice does.
Result<VoiceRequest> request_from_json(std::string_view text);

// ---- lines of the answer, as a voice writes them; each ends with a newline
/// `language`: of a sound that a recognizer gets.
std::string header_line(std::string_view name, std::uint32_t sample_rate, std::string_view language = "");
std::string audio_line(std::span<const std::int16_t> samples);
std::string line_of(const SpokenPhoneme& phoneme);
std::string line_of(const SpokenWord& word);
std::string line_of(const SpokenSentence& sentence);
std::string line_of(const SpokenMark& mark);
std::string line_of(const VoiceName& name);
/// What a recognizer has heard; `confidence`: 0..1, how sure it is of the words.
std::string heard_line(std::string_view text, double confidence);
std::string end_line();
/// `member` of the request that the voice cannot serve ("language", "voice", "text"); empty: none of them is to blame.
std::string error_line(std::string_view message, std::string_view member = "");

/// What a recognizer has heard in a sound.
struct Heard {
  Utterance said;           ///< its events, in characters of `text`; no samples
  std::string text;         ///< empty: no word
  double confidence = 0.0;  ///< 0..1: how sure it is of the words
};

/// Reads an answer line by line. A voice is another's program: every line is checked.
class VoiceAnswer {
 public:
  /// A line without its newline. After an error the answer is of no use. `unsupported`, with the member in `where`: the
  /// voice cannot serve this request.
  Status take(std::string_view line);
  /// The utterance, once `end` has come.
  Result<Utterance> finish() &&;
  /// The voices, once `end` has come, of an answer to a request with `list`.
  Result<std::vector<VoiceName>> finish_list() &&;
  /// What was heard in a sound of this duration, ms, once `end` has come, of a recognizer's answer.
  Result<Heard> finish_heard(double duration) &&;
  /// Of the header; empty if it names none. A recognizer reads it.
  [[nodiscard]] const std::string& language() const { return language_; }

 private:
  Status take_audio(std::string_view base64);
  [[nodiscard]] Status check_events_end() const;

  Utterance utterance_;
  std::vector<VoiceName> voices_;
  std::string language_, heard_;
  double confidence_ = 0.0;
  std::size_t events_ = 0;
  bool begun_ = false, ended_ = false;
};

}  // namespace semblante::voice

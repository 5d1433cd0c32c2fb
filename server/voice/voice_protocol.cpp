#include "server/voice/voice_protocol.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/json/base64.h"
#include "core/json/json_cursor.h"
#include "core/json/read_json.h"
#include "core/types/printable.h"

namespace semblante::voice {
namespace {

using nlohmann::json;

constexpr JsonLimits request_limits = {.max_bytes = max_request_bytes, .max_depth = 4, .max_values = 32};
constexpr JsonLimits line_limits = {.max_bytes = max_line_bytes, .max_depth = 4, .max_values = 32};

std::string line(const json& value) { return value.dump(-1, ' ', false, json::error_handler_t::replace) + "\n"; }

/// A name of a language or a voice reaches file names in some voices: no dots, no slashes.
bool is_name(std::string_view text) {
  return text.size() <= 64 && std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
                  c == '+';
         });
}

bool is_factor(double value) { return value >= least_factor && value <= most_factor; }  // false for NaN

/// What a reader of XML would expand or fetch has no place in a text to say.
Status check_ssml(std::string_view text) {
  std::size_t depth = 0;
  for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at + 1)) {
    const std::string_view rest = text.substr(at);
    if (rest.starts_with("<!--")) continue;
    if (rest.starts_with("<!") || rest.starts_with("<?"))
      return Error{ErrorCode::unsupported, "text", "SSML here has no declarations (byte " + std::to_string(at) + ")"};
    if (rest.starts_with("<audio") || rest.starts_with("<lexicon"))
      return Error{ErrorCode::unsupported, "text", "SSML here names no other files (byte " + std::to_string(at) + ")"};
    if (rest.starts_with("<voice"))
      return Error{ErrorCode::unsupported, "text", "a text has one voice (byte " + std::to_string(at) + ")"};
    const std::size_t close = rest.find('>');
    if (close == std::string_view::npos)
      return Error{ErrorCode::malformed, "text", "a tag has no end (byte " + std::to_string(at) + ")"};
    if (rest.starts_with("</")) {
      if (depth == 0)
        return Error{ErrorCode::malformed, "text", "closes what is not open (byte " + std::to_string(at) + ")"};
      --depth;
    } else if (rest[close - 1] != '/' && ++depth > 16) {
      return Error{ErrorCode::too_large, "text", "tags nest deeper than 16"};
    }
  }
  if (depth != 0) return Error{ErrorCode::malformed, "text", "a tag is not closed"};
  return Unit{};
}

Error refused(ErrorCode code, std::string where, std::string message) {
  return {code, std::move(where), "the voice's answer: " + std::move(message)};
}

template <class Events>
Status in_order(const Events& events, const char* what) {
  if (events.size() > 1 && events.back().time < events[events.size() - 2].time)
    return refused(ErrorCode::out_of_range, what, "times must not decrease");
  return Unit{};
}

}  // namespace

Status check_text(std::string_view text) {
  if (text.empty()) return Error{ErrorCode::empty, "text", "there is nothing to say"};
  if (text.size() > max_text_bytes)
    return Error{ErrorCode::too_large, "text", "is longer than " + std::to_string(max_text_bytes) + " bytes"};
  if (const std::size_t end = utf8_end(text); end != text.size())
    return Error{ErrorCode::malformed, "text", "is not UTF-8 at byte " + std::to_string(end)};
  for (std::size_t at = 0; at < text.size(); at += utf8_step(text.substr(at))) {
    const auto first = static_cast<unsigned char>(text[at]);
    const bool control = (first < 0x20 && text[at] != '\n' && text[at] != '\t') || first == 0x7F ||
                         (first == 0xC2 && static_cast<unsigned char>(text[at + 1]) < 0xA0);
    if (control) return Error{ErrorCode::malformed, "text", "has a control character at byte " + std::to_string(at)};
  }
  return Unit{};
}

Status check_language(std::string_view language) {
  if (language.empty() || !is_name(language))
    return Error{ErrorCode::invalid_argument, "language", "must be a tag such as pt-BR or en"};
  return Unit{};
}

Status check(const VoiceRequest& request) {
  if (auto checked = check_text(request.text); !checked) return checked;
  if (request.ssml) {
    if (auto checked = check_ssml(request.text); !checked) return checked;
  }
  if (auto checked = check_language(request.language); !checked) return checked;
  if (!is_name(request.voice)) return Error{ErrorCode::invalid_argument, "voice", "takes letters, digits, -, _ and +"};
  for (const auto& [name, value] : {std::pair{"rate", request.rate}, std::pair{"pitch", request.pitch}})
    if (!is_factor(value)) return Error{ErrorCode::out_of_range, name, "must be 0.5 to 2"};
  return Unit{};
}

std::string to_json(const VoiceRequest& request) {
  if (request.list) return line({{"protocol", protocol_version}, {"list", true}});
  return line({{"protocol", protocol_version},
               {"text", request.text},
               {"ssml", request.ssml},
               {"language", request.language},
               {"voice", request.voice},
               {"rate", request.rate},
               {"pitch", request.pitch}});
}

Result<VoiceRequest> request_from_json(std::string_view text) {
  const auto tree = read_json_tree(text, request_limits);
  if (!tree) return tree.error();
  JsonCursor::Report report;
  const JsonCursor root(*tree, report);
  root.must_be_object();
  VoiceRequest request;
  (void)root.member("protocol").integer(protocol_version, protocol_version);
  request.list = root.boolean_or("list", false);
  if (request.list) return report ? Result<VoiceRequest>(*report) : request;
  request.text = root.member("text").text(max_text_bytes);
  request.ssml = root.boolean_or("ssml", false);
  request.language = root.member("language").text(64);
  request.voice = root.text_or("voice", "");
  request.rate = root.number_or("rate", 1.0);
  request.pitch = root.number_or("pitch", 1.0);
  if (report) return *report;
  if (const auto checked = check(request); !checked) return checked.error();
  return request;
}

std::string header_line(std::string_view name, std::uint32_t sample_rate, std::string_view language) {
  json header = {{"protocol", protocol_version}, {"name", name}, {"sample_rate", sample_rate}};
  if (!language.empty()) header["language"] = language;
  return line(header);
}

std::string audio_line(std::span<const std::int16_t> samples) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(samples.size() * 2);
  for (const std::int16_t sample : samples) {
    const auto bits = static_cast<std::uint16_t>(sample);
    bytes.push_back(static_cast<std::uint8_t>(bits & 0xFFU));
    bytes.push_back(static_cast<std::uint8_t>(bits >> 8U));
  }
  return line({{"audio", to_base64(bytes)}});
}

std::string line_of(const SpokenPhoneme& phoneme) {
  return line({{"phoneme", phoneme.symbol}, {"time", phoneme.time}, {"stress", static_cast<unsigned>(phoneme.stress)}});
}
std::string line_of(const SpokenWord& word) {
  return line({{"word", {word.range.first, word.range.count}}, {"time", word.time}});
}
std::string line_of(const SpokenSentence& sentence) {
  return line({{"sentence", sentence.first}, {"time", sentence.time}});
}
std::string line_of(const SpokenMark& mark) { return line({{"mark", mark.name}, {"time", mark.time}}); }
std::string line_of(const VoiceName& name) {
  return line({{"voice", name.voice}, {"label", name.label}, {"language", name.language}});
}
std::string heard_line(std::string_view text, double confidence) {
  return line({{"heard", text}, {"confidence", confidence}});
}
std::string end_line() { return line({{"end", true}}); }
std::string error_line(std::string_view message, std::string_view member) {
  json error = {{"error", message}};
  if (!member.empty()) error["of"] = member;
  return line(error);
}

Status VoiceAnswer::take(std::string_view text) {
  if (ended_) return refused(ErrorCode::malformed, "", "goes on after its end");
  if (text.size() > max_line_bytes) return refused(ErrorCode::too_large, "", "a line is too long");
  const auto tree = read_json_tree(text, line_limits);
  if (!tree) return refused(tree.error().code, tree.error().where, tree.error().message);
  JsonCursor::Report report;
  const JsonCursor root(*tree, report);
  root.must_be_object();
  const auto failed = [&report] { return refused(report->code, report->where, report->message); };
  if (report) return failed();
  if (const auto message = root.optional_member("error")) {
    const std::string words = printable(message->text());
    const std::string member = root.text_or("of", "");
    if (report) return failed();
    if (member == "language" || member == "voice" || member == "text")
      return Error{ErrorCode::unsupported, member, words};
    return Error{ErrorCode::invalid_argument, "", words};
  }
  if (!begun_) {
    (void)root.member("protocol").integer(protocol_version, protocol_version);
    utterance_.voice = printable(root.member("name").text(max_name_bytes));
    utterance_.sample_rate =
        static_cast<std::uint32_t>(root.member("sample_rate").integer(least_sample_rate, most_sample_rate));
    language_ = root.text_or("language", "");
    if (report) return failed();
    if (!language_.empty() && !check_language(language_)) return refused(ErrorCode::malformed, "language", "is no tag");
    begun_ = true;
    return Unit{};
  }
  if (const auto audio = root.optional_member("audio")) {
    const std::string base64 = audio->text();
    if (report) return failed();
    return take_audio(base64);
  }
  if (const auto end = root.optional_member("end")) {
    ended_ = true;
    return Unit{};
  }
  if (const auto heard = root.optional_member("heard")) {
    heard_ = heard->text(max_text_bytes);
    confidence_ = root.member("confidence").number(0.0, 1.0);
    if (report) return failed();
    if (const auto checked = check_text(heard_); !checked && !heard_.empty())
      return refused(checked.error().code, "heard", checked.error().message);
    return Unit{};
  }
  if (const auto name = root.optional_member("voice")) {
    VoiceName known{name->text(64), printable(root.text_or("label", "")), root.member("language").text(64)};
    if (report) return failed();
    if (!is_name(known.voice) || !check_language(known.language))
      return refused(ErrorCode::malformed, "voice", "names have letters, digits, -, _ and + alone");
    if (voices_.size() == max_voices) return refused(ErrorCode::too_large, "voice", "has too many voices");
    voices_.push_back(std::move(known));
    return Unit{};
  }
  if (++events_ > max_events) return refused(ErrorCode::too_large, "", "has too many events");
  const double time = root.member("time").number(0.0, max_seconds * 1000.0);
  Status ordered = Unit{};
  if (const auto phoneme = root.optional_member("phoneme")) {
    const auto stress = static_cast<Stress>(root.has("stress") ? root.member("stress").integer(0, 2) : 0);
    utterance_.phonemes.push_back({time, phoneme->text(max_symbol_bytes), stress});
    ordered = in_order(utterance_.phonemes, "phoneme");
  } else if (const auto word = root.optional_member("word")) {
    const auto range = word->elements(2, 2);
    if (report) return failed();
    utterance_.words.push_back({time, {range[0].integer(0, max_text_bytes), range[1].integer(1, max_text_bytes)}});
    ordered = in_order(utterance_.words, "word");
  } else if (const auto sentence = root.optional_member("sentence")) {
    utterance_.sentences.push_back({time, sentence->integer(0, max_text_bytes)});
    ordered = in_order(utterance_.sentences, "sentence");
  } else if (const auto mark = root.optional_member("mark")) {
    utterance_.marks.push_back({time, printable(mark->text(max_name_bytes))});
    ordered = in_order(utterance_.marks, "mark");
  }  // a later version's events are skipped
  if (report) return failed();
  return ordered;
}

Status VoiceAnswer::take_audio(std::string_view base64) {
  const auto bytes = from_base64(base64);
  if (!bytes || bytes->size() % 2 != 0) return refused(ErrorCode::malformed, "audio", "is no base64 of samples");
  const auto most = static_cast<std::size_t>(max_seconds * utterance_.sample_rate);
  if (utterance_.samples.size() + bytes->size() / 2 > most)
    return refused(ErrorCode::too_large, "audio",
                   "is longer than " + std::to_string(static_cast<int>(max_seconds)) + " s");
  for (std::size_t i = 0; i < bytes->size(); i += 2) {
    const auto bits = static_cast<std::uint16_t>((*bytes)[i] | (*bytes)[i + 1] << 8U);
    utterance_.samples.push_back(static_cast<std::int16_t>(bits));
  }
  return Unit{};
}

Result<std::vector<VoiceName>> VoiceAnswer::finish_list() && {
  if (!ended_) return refused(ErrorCode::truncated, "", "has no end");
  return std::move(voices_);
}

Result<Utterance> VoiceAnswer::finish() && {
  if (!ended_) return refused(ErrorCode::truncated, "", "has no end");
  if (utterance_.samples.empty()) return refused(ErrorCode::empty, "audio", "there is no sound");
  utterance_.duration = 1000.0 * static_cast<double>(utterance_.samples.size()) / utterance_.sample_rate;
  if (const auto checked = check_events_end(); !checked) return checked.error();
  return std::move(utterance_);
}

Result<Heard> VoiceAnswer::finish_heard(double duration) && {
  if (!ended_) return refused(ErrorCode::truncated, "", "has no end");
  if (!utterance_.samples.empty()) return refused(ErrorCode::malformed, "audio", "what is heard has no sound");
  utterance_.duration = duration;
  if (const auto checked = check_events_end(); !checked) return checked.error();
  return Heard{std::move(utterance_), std::move(heard_), confidence_};
}

Status VoiceAnswer::check_events_end() const {
  const auto past = [this](const auto& events) {
    return !events.empty() && events.back().time > utterance_.duration + 1000.0;
  };
  if (past(utterance_.phonemes) || past(utterance_.words) || past(utterance_.sentences) || past(utterance_.marks))
    return refused(ErrorCode::out_of_range, "time", "an event comes after the sound");
  return Unit{};
}

}  // namespace semblante::voice

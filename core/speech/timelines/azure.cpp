#include <algorithm>
#include <optional>
#include <string>

#include "core/speech/timelines/formats.h"
#include "core/speech/timelines/timeline_json.h"
#include "core/speech/timelines/timeline_lines.h"
#include "core/speech/timelines/viseme_symbols.h"
#include "core/types/decimal.h"
#include "core/types/letter_case.h"

namespace semblante::visemes {
namespace {

constexpr VisemeSymbol azure_rows[] = {
    {"0", ""},   {"1", "ʌ"},  {"2", "ɑ"},   {"3", "ɔ"},   {"4", "ɛ"},  {"5", "ɝ"},  {"6", "ɪ"},  {"7", "u"},
    {"8", "o"},  {"9", "aʊ"}, {"10", "ɔɪ"}, {"11", "aɪ"}, {"12", "h"}, {"13", "ɹ"}, {"14", "l"}, {"15", "s"},
    {"16", "ʃ"}, {"17", "ð"}, {"18", "f"},  {"19", "t"},  {"20", "k"}, {"21", "p"},
};

}  // namespace

constinit const VisemeSymbols azure = {
    "azure",
    "Microsoft, Azure AI Speech documentation, Get facial position with viseme, table \"Map phonemes to visemes\" "
    "(learn.microsoft.com/azure/ai-services/speech-service/how-to-speech-synthesis-viseme)",
    azure_rows};

}  // namespace semblante::visemes

namespace semblante {
namespace {

constexpr double ticks_per_ms = 10'000.0;

/// The number after `name` and blanks, in any case of letters: "Audio offset: 850ms".
std::optional<double> number_after(std::string_view line, std::string_view name) {
  const auto* const at = std::search(line.begin(), line.end(), name.begin(), name.end(),
                                     [](char a, char b) { return lower_case(a) == b; });
  if (at == line.end()) return std::nullopt;
  std::string_view rest = line.substr(static_cast<std::size_t>(at - line.begin()) + name.size());
  rest.remove_prefix(std::min(rest.find_first_not_of(": "), rest.size()));
  std::size_t size = std::min(rest.find_first_not_of("0123456789."), rest.size());
  while (size > 0 && rest[size - 1] == '.') --size;  // the end of a sentence
  return read_double(rest.substr(0, size));
}

void read_printed_azure(std::string_view file, TimelineBuilder& builder) {
  each_line(file, builder, [&](std::string_view line, const std::string& where) {
    if (line.starts_with("…")) return;  // as the documentation leaves lines out
    const auto viseme = number_after(line, "viseme id"), offset = number_after(line, "audio offset");
    if (!viseme || !offset)
      return builder.fail(ErrorCode::malformed, where, "must have a \"Viseme ID\" and an \"Audio offset\"");
    builder.sound(shortest_fixed_text(*viseme), *offset, {}, where);
  });
}

}  // namespace

void read_azure(std::string_view file, TimelineBuilder& builder) {
  if (file.find('{') == std::string_view::npos) return read_printed_azure(file, builder);
  each_value(file, builder, [&](const JsonCursor& event) {
    event.must_be_object();
    const auto offset = member_of(event, {"audioOffset", "audio_offset", "AudioOffset", "privAudioOffset"});
    const double time =
        (offset ? *offset : event.member("audioOffset")).number(0.0, most_timeline_ms * ticks_per_ms) / ticks_per_ms;
    if (event.failed()) return;
    if (const auto viseme = member_of(event, {"visemeId", "viseme_id", "VisemeId", "privVisemeId"})) {
      builder.sound(std::to_string(viseme->integer()), time, {}, viseme->pointer());
    } else if (const auto text = member_of(event, {"text", "Text", "privText"})) {  // of a word boundary
      const auto kind = member_of(event, {"boundaryType", "boundary_type", "BoundaryType", "privBoundaryType"});
      const std::string said = text->text(most_text_bytes);
      const std::string what = kind && kind->is_text() ? kind->text(most_text_bytes) : "";
      if (what.find("Sentence") != std::string::npos)
        builder.sentence(time, said, text->pointer());
      else if (what.find("Punctuation") == std::string::npos)
        builder.word(time, said, text->pointer());
    }  // bookmarks and later events
  });
}

}  // namespace semblante

#include <algorithm>
#include <string>

#include "core/speech/timelines/formats.h"
#include "core/speech/timelines/timeline_json.h"
#include "core/speech/timelines/timeline_lines.h"
#include "core/speech/timelines/viseme_symbols.h"

namespace semblante::visemes {
namespace {

constexpr VisemeSymbol rhubarb_rows[] = {
    {"A", "m"},  // closed
    {"B", "s"},  // slightly open, teeth together: most consonants, and "ee"
    {"C", "ɛ"},  // open
    {"D", "ɑ"},  // wide open
    {"E", "ɔ"},  // slightly rounded
    {"F", "u"},  // puckered
    {"G", "f"},  // upper teeth on the lower lip
    {"H", "l"},  // the tongue behind the upper teeth
    {"X", ""},   // at rest
};

}  // namespace

constinit const VisemeSymbols rhubarb = {
    "rhubarb", "D. S. Wolf, Rhubarb Lip Sync, README, Mouth shapes (github.com/DanielSWolf/rhubarb-lip-sync)",
    rhubarb_rows};

}  // namespace semblante::visemes

namespace semblante {
namespace {

void read_rhubarb_json(std::string_view file, TimelineBuilder& builder) {
  read_object(file, builder, [&](const JsonCursor& root) {
    for (const JsonCursor& cue : root.member("mouthCues").elements(1, max_timeline_events)) {
      const double begin = 1000.0 * cue.member("start").number(0.0, max_speech_seconds);
      const double end = 1000.0 * cue.member("end").number(0.0, max_speech_seconds);
      const std::string shape = cue.member("value").text(most_symbol_bytes);
      if (root.failed() || builder.failed()) return;
      builder.sound(shape, begin, end, cue.pointer());
    }
  });
}

/// The value of an attribute, `name="..."`, of the tag; empty without it.
std::string_view attribute(std::string_view tag, std::string_view name) {
  const std::string begin = " " + std::string(name) + "=\"";
  const std::size_t at = tag.find(begin);
  if (at == std::string_view::npos) return {};
  const std::string_view value = tag.substr(at + begin.size());
  return value.substr(0, value.find('"'));
}

/// The elements "mouthCue" of the document: it has no others that matter. Declarations, which could define entities,
/// are refused.
void read_rhubarb_xml(std::string_view file, TimelineBuilder& builder) {
  constexpr std::string_view open = "<mouthCue ", close = "</mouthCue>";
  if (file.find("<!DOCTYPE") != std::string_view::npos)
    return builder.fail(ErrorCode::unsupported, "byte " + std::to_string(file.find("<!DOCTYPE")),
                        "the document has a declaration");
  for (std::size_t at = file.find(open); at != std::string_view::npos && !builder.failed();
       at = file.find(open, at + 1)) {
    const std::string where = "byte " + std::to_string(at);
    const std::string_view element = file.substr(at, std::min(file.find(close, at), file.size()) - at);
    const std::size_t end_of_tag = element.find('>');
    if (end_of_tag == std::string_view::npos || at + element.size() == file.size())
      return builder.fail(ErrorCode::malformed, where, "an element mouthCue has no end");
    const std::string_view tag = element.substr(0, end_of_tag);
    builder.sound(element.substr(end_of_tag + 1), ms_of_seconds(attribute(tag, "start")),
                  ms_of_seconds(attribute(tag, "end")), where);
  }
}

}  // namespace

void read_rhubarb(std::string_view file, TimelineBuilder& builder) {
  const std::size_t first = std::min(file.find_first_not_of(" \t\r\n"), file.size());
  if (file.substr(first).starts_with('<')) return read_rhubarb_xml(file, builder);
  if (file.substr(first).starts_with('{')) return read_rhubarb_json(file, builder);
  read_table(file, 2, builder);
}

}  // namespace semblante

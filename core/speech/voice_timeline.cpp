#include "core/speech/voice_timeline.h"

#include <algorithm>
#include <utility>

#include "core/speech/timelines/formats.h"
#include "core/speech/timelines/timeline_builder.h"
#include "core/speech/timelines/viseme_symbols.h"

namespace semblante {
namespace {

/// The format that a file looks like, by its first signs and the members that only one has.
std::optional<TimelineFormat> looks_like(std::string_view file) {
  const std::string_view start = file.substr(std::min(file.find_first_not_of(" \t\r\n"), file.size()));
  const auto has = [&file](std::string_view name) { return file.find(name) != std::string_view::npos; };
  if (start.starts_with('{') || start.starts_with('[')) {
    if (has("\"semblante.timeline\"")) return TimelineFormat::semblante;
    if (has("\"mouthCues\"")) return TimelineFormat::rhubarb;
    if (has("\"vtimes\"")) return TimelineFormat::headtts;
    if (has("\"type\"") && has("\"value\"")) return TimelineFormat::polly;
    if (has("iseme")) return TimelineFormat::azure;
    return std::nullopt;
  }
  if (start.starts_with('<')) return TimelineFormat::rhubarb;
  const std::string_view line = start.substr(0, start.find('\n'));
  const auto columns = static_cast<std::size_t>(std::count(line.begin(), line.end(), '\t')) + 1;
  if (columns == 3) return TimelineFormat::phonemes;
  if (columns == 2) return TimelineFormat::rhubarb;
  if (has("iseme")) return TimelineFormat::azure;
  return std::nullopt;
}

}  // namespace

Result<VoiceTimeline> read_voice_timeline(std::string_view file, std::optional<TimelineFormat> format) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (file.starts_with(byte_order_mark)) file.remove_prefix(byte_order_mark.size());
  if (file.size() > max_timeline_bytes)
    return Error{ErrorCode::too_large, "", "is longer than " + std::to_string(max_timeline_bytes) + " bytes"};
  if (!format) format = looks_like(file);
  if (!format) return Error{ErrorCode::unsupported, "", "is of no format that is known here: name it"};
  const auto built = [&](const VisemeSymbols* symbols, auto read) {
    TimelineBuilder builder(*format, symbols);
    read(file, builder);
    return std::move(builder).finish();
  };
  switch (*format) {
    case TimelineFormat::semblante:
      return built(nullptr, read_semblante);
    case TimelineFormat::azure:
      return built(&visemes::azure, read_azure);
    case TimelineFormat::polly:
      return built(&visemes::polly, read_polly);
    case TimelineFormat::rhubarb:
      return built(&visemes::rhubarb, read_rhubarb);
    case TimelineFormat::headtts:
      return built(&visemes::oculus, read_headtts);
    case TimelineFormat::phonemes:
      break;
  }
  return built(nullptr, read_phonemes);
}

}  // namespace semblante

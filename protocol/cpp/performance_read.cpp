#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/json/json_cursor.h"
#include "core/json/json_tree.h"
#include "core/tables/mpeg4.h"
#include "core/types/decimal.h"
#include "protocol/cpp/performance_document.h"

namespace semblante {
namespace {

constexpr std::size_t max_performance_text_bytes = 1000;

// ---- one cue

constexpr auto easing_names =
    std::to_array<std::string_view>({"linear", "ease_in", "ease_out", "ease_in_out", "step"});  // as EasingKind
constexpr auto target_names =
    std::to_array<std::string_view>({"fap", "viseme", "expression", "look_at", "blink", "head"});  // as CueTarget

/// Reads a name in a table of the standard as its index, or a number; fails outside `least` to `most`.
template <class Table>
std::uint8_t named_or_numbered(const JsonCursor& at, const Table& table, std::size_t first_number, std::size_t least,
                               const char* what) {
  const std::size_t most = first_number + table.size() - 1;
  if (!at.is_text()) return static_cast<std::uint8_t>(at.integer(least, most));
  const std::string name = at.text(64);
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table[i].name == name && first_number + i >= least) return static_cast<std::uint8_t>(first_number + i);
  }
  at.fail(ErrorCode::invalid_argument, "there is no " + std::string(what) + " of this name");
  return static_cast<std::uint8_t>(least);
}

std::uint8_t read_viseme(const JsonCursor& at) { return named_or_numbered(at, mpeg4::visemes, 0, 0, "viseme"); }

VisemeTarget read_viseme_target(const JsonCursor& at) {
  if (!at.is_array()) return {read_viseme(at), 0};
  const auto pair = at.elements(2, 2);
  if (at.failed()) return {};
  return {read_viseme(pair[0]), read_viseme(pair[1])};
}

void refuse_unknown(const JsonCursor& at, std::initializer_list<std::string_view> known) {
  for (const auto& [name, member] : at.members()) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      member.fail(ErrorCode::invalid_argument, "unknown member");
  }
}

double number_or(const JsonCursor& of, const char* name, double otherwise) {
  const auto at = of.optional_member(name);
  return at ? at->number() : otherwise;
}

std::optional<double> optional_number(const JsonCursor& of, const char* name) {
  const auto at = of.optional_member(name);
  return at ? std::optional(at->number()) : std::nullopt;
}

LookTarget read_look(const JsonCursor& at) {
  refuse_unknown(at, {"yaw", "pitch", "distance", "point", "head_share"});
  LookTarget look;
  look.head_share = number_or(at, "head_share", look.head_share);
  const auto point = at.optional_member("point");
  if (!point) {
    look.yaw = number_or(at, "yaw", 0.0);
    look.pitch = number_or(at, "pitch", 0.0);
    look.distance = number_or(at, "distance", look.distance);
    return look;
  }
  for (const char* other : {"yaw", "pitch", "distance"}) {
    if (const auto both = at.optional_member(other))
      both->fail(ErrorCode::invalid_argument, "is not allowed beside point");
  }
  const auto xyz = point->elements(3, 3);
  if (at.failed()) return look;
  const double x = xyz[0].number(-1e6, 1e6);
  const double y = xyz[1].number(-1e6, 1e6);
  const double z = xyz[2].number(0.1, 1e6);
  if (at.failed()) return look;
  constexpr double degrees = 57.29577951308232;
  look.yaw = std::atan2(x, z) * degrees;
  look.pitch = std::atan2(-y, std::hypot(x, z)) * degrees;
  look.distance = std::hypot(x, y, z);
  if (look.distance < 1.0) point->fail(ErrorCode::out_of_range, "is nearer than one eye distance");
  return look;
}

BlinkTarget read_blink(const JsonCursor& at) {
  const std::string side = at.text(16);
  if (side == "both") return {true, true};
  if (side == "left") return {true, false};
  if (side == "right") return {false, true};
  at.fail(ErrorCode::invalid_argument, "must be both, left or right");
  return {};
}

HeadTarget read_head(const JsonCursor& at) {
  refuse_unknown(at, {"pitch", "yaw", "roll"});
  return {number_or(at, "pitch", 0.0), number_or(at, "yaw", 0.0), number_or(at, "roll", 0.0)};
}

CueTarget read_target(const JsonCursor& cue) {
  std::optional<JsonCursor> found;
  std::size_t kind = 0;
  for (std::size_t k = 0; k < target_names.size(); ++k) {
    const auto member = cue.optional_member(target_names[k]);
    if (!member) continue;
    if (found) member->fail(ErrorCode::invalid_argument, "a cue has one target, and this is its second");
    found.emplace(*member);
    kind = k;
  }
  if (!found) {
    cue.fail(ErrorCode::missing, "has no target: fap, viseme, expression, look_at, blink or head");
    return {};
  }
  switch (kind) {
    case 0:
      return FapTarget{named_or_numbered(*found, mpeg4::faps, 1, 3, "low-level FAP")};
    case 1:
      return read_viseme_target(*found);
    case 2:
      return ExpressionTarget{named_or_numbered(*found, mpeg4::expressions, 0, 1, "expression")};
    case 3:
      return read_look(*found);
    case 4:
      return read_blink(*found);
    default:
      return read_head(*found);
  }
}

Easing read_easing(const JsonCursor& at) {
  Easing easing;
  if (at.is_array()) {
    const auto points = at.elements(4, 4);
    if (at.failed()) return easing;
    easing = {EasingKind::bezier, points[0].number(), points[1].number(), points[2].number(), points[3].number()};
    return easing;
  }
  const std::string name = at.text(64);
  const auto found = std::find(easing_names.begin(), easing_names.end(), name);
  if (found == easing_names.end())
    at.fail(ErrorCode::invalid_argument, "must be linear, ease_in, ease_out, ease_in_out, step or four numbers");
  easing.kind = static_cast<EasingKind>(found == easing_names.end() ? 0 : found - easing_names.begin());
  return easing;
}

Cue read_cue(const JsonCursor& at) {
  Cue cue;
  cue.target = read_target(at);
  if (at.failed()) return cue;
  const std::string_view own = target_names[cue.target.index()];
  const bool turns = own == "look_at" || own == "head";
  if (turns) {
    refuse_unknown(at, {"time", "duration", "attack", "release", "easing", "note", own});
  } else if (own == "blink") {
    refuse_unknown(at, {"time", "duration", "attack", "release", "easing", "note", own, "value"});
  } else {
    refuse_unknown(at, {"time", "duration", "attack", "release", "easing", "note", own, "value", "keys"});
  }
  cue.time = at.member("time").number();
  cue.duration = optional_number(at, "duration");
  cue.attack = optional_number(at, "attack");
  cue.release = optional_number(at, "release");
  if (const auto easing = at.optional_member("easing")) cue.easing = read_easing(*easing);
  if (const auto note = at.optional_member("note")) (void)note->text(max_performance_text_bytes);
  const auto value = at.optional_member("value");
  if (const auto keys = at.optional_member("keys")) {
    if (value) value->fail(ErrorCode::invalid_argument, "is not allowed beside keys");
    for (const auto& key : keys->elements(1, max_performance_keys)) {
      const auto pair = key.elements(2, 2);
      if (at.failed()) return cue;
      cue.keys.push_back({pair[0].number(), pair[1].number()});
    }
  } else if (value) {
    cue.value = value->number();
  } else if (own == "fap") {
    at.fail(ErrorCode::missing, "has neither value nor keys");
  }
  return cue;
}

IdleLife read_idle(const JsonCursor& at) {
  refuse_unknown(at, {"seed", "blinks_per_minute", "head", "eyes"});
  IdleLife idle;
  if (const auto seed = at.optional_member("seed"))
    idle.seed = static_cast<std::uint32_t>(seed->integer(0, 4294967295));
  idle.blinks_per_minute = number_or(at, "blinks_per_minute", idle.blinks_per_minute);
  idle.head = number_or(at, "head", idle.head);
  idle.eyes = number_or(at, "eyes", idle.eyes);
  return idle;
}

// ---- the document

/// Reads all members except the cues.
void read_members(const JsonCursor& root, PerformanceScript& script) {
  refuse_unknown(root, {"format", "version", "name", "note", "duration", "idle", "cues"});
  if (const auto format = root.member("format"); format.text(64) != performance_format)
    format.fail(ErrorCode::unsupported, "must be \"" + std::string(performance_format) + "\"");
  const auto version = root.member("version");
  if (version.number() != performance_version)
    version.fail(ErrorCode::unsupported, "the supported version is " + natural_text(performance_version));
  if (const auto name = root.optional_member("name")) script.name = name->text(max_performance_text_bytes);
  if (const auto note = root.optional_member("note")) (void)note->text(max_performance_text_bytes);
  script.duration = optional_number(root, "duration");
  if (const auto idle = root.optional_member("idle")) script.idle = read_idle(*idle);
  if (const auto cues = root.optional_member("cues")) {
    (void)cues->size();  // must be an array; it is empty here, because its elements were read one by one
  } else if (!script.idle) {
    root.member("cues").fail(ErrorCode::missing, "is required where there is no idle life");
  }
}

/// A key is a list of two numbers; a single cue may contain the maximum number of keys.
constexpr JsonLimits limits = {
    .max_bytes = max_performance_bytes, .max_depth = 5, .max_values = 4 * max_performance_keys};

}  // namespace

Result<PerformanceScript> read_performance(std::string_view text) {
  PerformanceScript script;
  std::size_t keys = 0;
  const auto take = [&](std::size_t index, const JsonView& element) -> Status {
    if (index == max_performance_cues)
      return Error{ErrorCode::too_large, "/cues",
                   "a performance has at most " + natural_text(max_performance_cues) + " cues"};
    JsonCursor::Report report;
    const JsonCursor at(element, "/cues/" + natural_text(index), report);
    Cue cue = read_cue(at);
    keys += cue.keys.size();
    if (!report && keys > max_performance_keys)
      at.member("keys").fail(ErrorCode::too_large, "more than " + natural_text(max_performance_keys) + " keys in all");
    if (report) return *report;
    script.cues.push_back(std::move(cue));
    return Unit{};
  };
  const JsonElements elements{"cues", take};
  const auto tree = read_json_object_tree(text, limits, &elements);
  if (!tree) return tree.error();
  JsonCursor::Report report;
  read_members(JsonCursor(*tree, report), script);
  if (report) return *report;
  return script;
}

}  // namespace semblante

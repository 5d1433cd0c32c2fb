#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "core/tables/mpeg4.h"
#include "protocol/cpp/json_cursor.h"
#include "protocol/cpp/performance_document.h"

namespace semblante {
namespace {

using nlohmann::json;

constexpr std::size_t max_text_bytes = 1000;
constexpr std::size_t max_name_bytes = 64;
constexpr std::size_t max_depth = 5;  // document, cues, cue, keys, key

// ---- one cue

constexpr auto easing_names =
    std::to_array<std::string_view>({"linear", "ease_in", "ease_out", "ease_in_out", "step"});  // as EasingKind
constexpr auto target_names =
    std::to_array<std::string_view>({"fap", "viseme", "expression", "look_at", "blink", "head"});  // as CueTarget

/// The place of a name among the entries of a table of the standard, or its number; fails beyond `least` to `most`.
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
      member.fail(ErrorCode::invalid_argument, "there is no such member here");
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
    if (const auto both = at.optional_member(other)) both->fail(ErrorCode::invalid_argument, "a point says it already");
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
  if (const auto note = at.optional_member("note")) (void)note->text(max_text_bytes);
  const auto value = at.optional_member("value");
  if (const auto keys = at.optional_member("keys")) {
    if (value) value->fail(ErrorCode::invalid_argument, "the keys say it already");
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

/// Builds the members of the document one by one, and of "cues" element by element, so that no more of the tree is ever
/// in memory than one cue and what is kept of those before.
class DocumentReader : public nlohmann::json_sax<json> {
 public:
  bool null() override { return take(json(nullptr)); }
  bool boolean(bool value) override { return take(json(value)); }
  bool number_integer(number_integer_t value) override { return take(json(value)); }
  bool number_unsigned(number_unsigned_t value) override { return take(json(value)); }
  bool number_float(number_float_t value, const string_t& /*text*/) override { return take(json(value)); }
  bool string(string_t& value) override { return take(json(std::move(value))); }
  bool binary(binary_t& /*value*/) override { return fail(ErrorCode::malformed, pointer(), "is not JSON"); }

  bool key(string_t& name) override {
    if (name.size() > max_name_bytes) return fail(ErrorCode::too_large, pointer(), "has a member of too long a name");
    if (open_.empty()) {
      member_ = name;
      if (!members_seen_.insert(name).second) return fail(ErrorCode::malformed, pointer(), "is there twice");
      if (members_seen_.size() > most_members)
        return fail(ErrorCode::too_large, "", "has more members than it can have");
      return true;
    }
    key_ = name;
    if (open_.back()->contains(name))
      return fail(ErrorCode::malformed, pointer() + "/" + JsonCursor::escaped(name), "is there twice");
    return true;
  }
  bool start_object(std::size_t /*size*/) override { return start(json::object()); }
  bool start_array(std::size_t /*size*/) override { return start(json::array()); }
  bool end_object() override { return end(); }
  bool end_array() override { return end(); }

  bool parse_error(std::size_t position, const std::string& /*token*/, const json::exception& error) override {
    // 4xx are numbers too large to be one, everything else is no JSON.
    if (error.id / 100 == 4) return fail(ErrorCode::not_finite, pointer(), "a number too large to be one");
    return fail(ErrorCode::malformed, pointer(), "not JSON from byte " + std::to_string(position));
  }

  Result<PerformanceScript> finish() {
    if (!fault_) read_members();
    if (fault_) return *fault_;
    return std::move(script_);
  }

 private:
  bool fail(ErrorCode code, std::string where, std::string message) {
    if (!fault_) fault_ = Error{code, std::move(where), std::move(message)};
    return false;
  }
  [[nodiscard]] bool in_cues() const { return in_cues_; }
  [[nodiscard]] std::string pointer() const {
    if (depth_ == 0 || member_.empty()) return "";
    std::string text = "/" + JsonCursor::escaped(member_);
    if (in_cues_) text += "/" + std::to_string(script_.cues.size());
    return text;
  }

  bool start(json value) {
    if (++depth_ > max_depth) return fail(ErrorCode::too_large, pointer(), "is nested too deep");
    if (depth_ == 1) {
      if (!value.is_object()) return fail(ErrorCode::malformed, "", "must be an object, not an array");
      return true;
    }
    if (depth_ == 2 && member_ == "cues") {
      if (!value.is_array()) return fail(ErrorCode::malformed, "/cues", "must be an array, not an object");
      in_cues_ = true;
      return true;
    }
    if (!open_.empty() && !count()) return false;
    open_.push_back(open_.empty() ? (unit_ = std::move(value), &unit_) : put(std::move(value)));
    return true;
  }
  /// One more value of the unit; lists and objects are values too, since an empty one takes memory as well.
  bool count() {
    return ++values_ <= most_values || fail(ErrorCode::too_large, pointer(), "has more values than anything here");
  }
  json* put(json value) {
    json& parent = *open_.back();
    if (parent.is_array()) return &parent.emplace_back(std::move(value));
    return &(parent[key_] = std::move(value));
  }
  bool take(json value) {
    if (depth_ == 0) return fail(ErrorCode::malformed, "", "must be an object, not " + std::string(value.type_name()));
    if (!open_.empty()) {
      if (!count()) return false;
      put(std::move(value));
      return true;
    }
    unit_ = std::move(value);
    return complete();
  }
  bool end() {
    --depth_;
    if (!open_.empty()) {
      open_.pop_back();
      return !open_.empty() || complete();
    }
    in_cues_ = false;  // of the cues, or of the document
    return true;
  }

  /// A member of the document, or a cue, stands in unit_.
  bool complete() {
    values_ = 0;
    if (!in_cues_) {
      if (member_ == "cues") return fail(ErrorCode::malformed, "/cues", "must be an array");
      members_[member_] = std::move(unit_);
      return true;
    }
    const std::size_t number = script_.cues.size();
    if (number == max_performance_cues)
      return fail(ErrorCode::too_large, "/cues",
                  "a performance has at most " + std::to_string(max_performance_cues) + " cues");
    JsonCursor::Report report;
    Cue cue = read_cue(JsonCursor(unit_, "/cues/" + std::to_string(number), report));
    keys_ += cue.keys.size();
    if (!report && keys_ > max_performance_keys)
      report = Error{ErrorCode::too_large, pointer() + "/keys",
                     "more than " + std::to_string(max_performance_keys) + " keys in all"};
    if (report) {
      fault_ = std::move(report);
      return false;
    }
    script_.cues.push_back(std::move(cue));
    return true;
  }

  void read_members() {
    JsonCursor::Report report;
    const JsonCursor root(members_, "", report);
    refuse_unknown(root, {"format", "version", "name", "note", "duration", "idle"});
    if (const auto format = root.member("format"); format.text(64) != performance_format)
      format.fail(ErrorCode::unsupported, "must be \"" + std::string(performance_format) + "\"");
    const auto version = root.member("version");
    if (version.number() != performance_version)
      version.fail(ErrorCode::unsupported, "this reader knows version " + std::to_string(performance_version));
    if (const auto name = root.optional_member("name")) script_.name = name->text(max_text_bytes);
    if (const auto note = root.optional_member("note")) (void)note->text(max_text_bytes);
    script_.duration = optional_number(root, "duration");
    if (const auto idle = root.optional_member("idle")) script_.idle = read_idle(*idle);
    if (!members_seen_.contains("cues") && !script_.idle && !report)
      report = Error{ErrorCode::missing, "/cues", "is required where there is no idle life"};
    if (report) fault_ = std::move(report);
  }

  static constexpr std::size_t most_values = 4 * max_performance_keys;  ///< a key is a list of two numbers
  static constexpr std::size_t most_members = 64;

  PerformanceScript script_;
  json members_ = json::object();       ///< all but the cues
  std::set<std::string> members_seen_;  ///< "cues" too
  std::string member_;                  ///< of the document, being read
  bool in_cues_ = false;
  std::size_t depth_ = 0;
  json unit_;                ///< the member or the cue that is being built
  std::vector<json*> open_;  ///< its objects and arrays that are not closed yet
  std::string key_;
  std::size_t values_ = 0;  ///< of the unit
  std::size_t keys_ = 0;    ///< of all cues
  std::optional<Error> fault_;
};

}  // namespace

Result<PerformanceScript> read_performance(std::string_view text) {
  if (text.size() > max_performance_bytes)
    return Error{ErrorCode::too_large, "",
                 "a performance document has at most " + std::to_string(max_performance_bytes) + " bytes"};
  DocumentReader reader;
  (void)json::sax_parse(text.begin(), text.end(), &reader);
  return reader.finish();
}

}  // namespace semblante

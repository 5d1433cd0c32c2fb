#include "core/extract/set_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/import/json_vector.h"
#include "core/import/text.h"
#include "core/json/json_cursor.h"
#include "core/json/read_json.h"
#include "core/types/printable.h"

namespace semblante {
namespace {

constexpr std::size_t max_name_bytes = 200;
constexpr JsonLimits set_limits = {.max_depth = 16, .max_values = 10'000};

void read_displacements(const JsonCursor& displacements, std::vector<Displacement>& out) {
  for (const auto& [name, cursor] : displacements.members()) {
    const auto id = parse_feature_point(name);
    if (!id) {
      cursor.fail(ErrorCode::invalid_argument, import::shown(name) + " is not a feature point of MPEG-4 (2.1 to 11.6)");
    }
    const glm::dvec3 value = import::read_vector(cursor);
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(value[axis]) <= most_set_units) continue;
      cursor.fail(ErrorCode::out_of_range, "moves by more than 102400 units");
    }
    if (cursor.failed()) return;
    const glm::vec3 units(value);
    if (units != glm::vec3(0.0F)) out.push_back({*id, units});
  }
  std::sort(out.begin(), out.end(), [](const Displacement& a, const Displacement& b) { return a.point < b.point; });
}

/// The double with the same shortest text as the float: 0.1 for 0.1F, not 0.10000000149011612.
double as_short_as_may_be(float value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  double result = 0.0;
  std::from_chars(text.data(), end, result);
  return result;
}

}  // namespace

Result<NamedSet> parse_displacement_set(std::string_view json) {
  const auto tree = read_json_object_tree(json, set_limits);
  if (!tree) return tree.error();
  std::optional<Error> fault;
  const JsonCursor root(*tree, fault);
  NamedSet set;
  set.name = root.text_or("name", "");
  if (set.name.size() > max_name_bytes || set.name != printable(set.name))
    root.member("name").fail(ErrorCode::invalid_argument, "must be at most 200 bytes of printable text");
  const auto kind = parse_set_kind(root.text_or("kind", "expression"));
  if (!kind) root.member("kind").fail(ErrorCode::invalid_argument, "must be \"viseme\" or \"expression\"");
  const JsonCursor displacements = root.member("displacements");
  if (fault) return *fault;
  set.kind = *kind;
  read_displacements(displacements, set.displacements);
  if (fault) return *fault;
  return set;
}

Result<std::vector<Displacement>> parse_set_displacements(std::string_view json) {
  const auto tree = read_json_object(json, set_limits);
  if (!tree) return tree.error();
  return displacements_from_json(*tree);
}

Result<std::vector<Displacement>> displacements_from_json(const nlohmann::json& json) {
  std::optional<Error> fault;
  std::vector<Displacement> displacements;
  read_displacements(JsonCursor(json_view(json), fault), displacements);
  if (fault) return *fault;
  return displacements;
}

nlohmann::ordered_json displacements_to_json(const std::vector<Displacement>& displacements) {
  auto json = nlohmann::ordered_json::object();
  for (const Displacement& d : displacements)
    json[to_string(d.point)] = {as_short_as_may_be(d.value.x), as_short_as_may_be(d.value.y),
                                as_short_as_may_be(d.value.z)};
  return json;
}

std::string write_displacement_set(const NamedSet& set) {
  nlohmann::ordered_json json = {{"name", set.name}, {"kind", std::string(to_string(set.kind))}};
  json["displacements"] = displacements_to_json(set.displacements);
  return json.dump(1) + "\n";
}

}  // namespace semblante

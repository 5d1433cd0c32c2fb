#include "core/import/displacements_file.h"

#include <algorithm>

#include "core/import/json_vector.h"
#include "core/import/text.h"
#include "core/json/json_cursor.h"
#include "core/json/json_tree.h"

namespace semblante {
namespace {

constexpr JsonLimits displacement_limits = {.max_bytes = std::size_t{1} << 20U, .max_depth = 16, .max_values = 10'000};

}  // namespace

Result<std::vector<std::pair<FeaturePointId, glm::dvec3>>> parse_displacements(std::string_view json) {
  const auto tree = read_json_object_tree(json, displacement_limits);
  if (!tree) return tree.error();
  std::optional<Error> fault;
  const JsonCursor root(*tree, fault);
  std::vector<std::pair<FeaturePointId, glm::dvec3>> displacements;
  for (const auto& [name, displacement] : root.members()) {
    const auto id = parse_feature_point(name);
    if (!id) {
      return Error{ErrorCode::invalid_argument, displacement.pointer(),
                   import::shown(name) + " is not a feature point of MPEG-4 (2.1 to 11.6)"};
    }
    displacements.emplace_back(*id, import::read_vector(displacement));
    if (fault) return *fault;
  }
  if (displacements.empty()) return Error{ErrorCode::empty, "", "no feature point has a displacement"};
  std::sort(displacements.begin(), displacements.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return displacements;
}

}  // namespace semblante

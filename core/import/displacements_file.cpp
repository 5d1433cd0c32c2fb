#include "core/import/displacements_file.h"

#include <algorithm>

#include "core/import/json.h"
#include "core/import/json_vector.h"
#include "core/import/text.h"

namespace semblante {

Result<std::vector<std::pair<FeaturePointId, glm::dvec3>>> parse_displacements(std::string_view json) {
  const auto tree = import::parse_json(json);
  if (!tree) return tree.error();
  std::optional<Error> fault;
  const import::JsonCursor root(*tree, fault);
  root.must_be_object();
  if (fault) return *fault;
  std::vector<std::pair<FeaturePointId, glm::dvec3>> displacements;
  for (const auto& member : tree->items()) {
    const auto id = parse_feature_point(member.key());
    if (!id) {
      return Error{ErrorCode::invalid_argument, std::string("/").append(import::pointer_segment(member.key())),
                   import::shown(member.key()) + " is not a feature point of MPEG-4 (2.1 to 11.6)"};
    }
    displacements.emplace_back(*id, import::read_vector(root[member.key().c_str()]));
    if (fault) return *fault;
  }
  if (displacements.empty()) return Error{ErrorCode::empty, "", "no feature point is moved"};
  std::sort(displacements.begin(), displacements.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return displacements;
}

}  // namespace semblante

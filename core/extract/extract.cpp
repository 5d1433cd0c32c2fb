#include "core/extract/extract.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/extract/head_motion.h"
#include "core/extract/named_set.h"

namespace semblante {
namespace {

Status check_options(const ExtractOptions& options) {
  if (!std::isfinite(options.least) || options.least < 0.0)
    return Error{ErrorCode::invalid_argument, "/least", "must be a finite number of at least 0"};
  if (!std::isfinite(options.strength) || options.strength < least_strength || options.strength > most_strength)
    return Error{ErrorCode::invalid_argument, "/strength", "must be a number from 0.01 to 100"};
  return Unit{};
}

Status check_shapes(std::span<const glm::vec3> neutral, std::span<const glm::vec3> expression) {
  if (neutral.size() != expression.size()) {
    return Error{ErrorCode::mismatch, "/expression",
                 "the expression has " + std::to_string(expression.size()) + " vertices, the neutral head " +
                     std::to_string(neutral.size()) + ": both must be the same mesh with the same vertex order"};
  }
  // A morph target can move finite vertices outside the range of float; checks the neutral shape too.
  const auto is_finite = [](const glm::vec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  };
  for (std::size_t v = 0; v < expression.size(); ++v) {
    if (is_finite(neutral[v]) && is_finite(expression[v])) continue;
    return Error{ErrorCode::not_finite, "vertex " + std::to_string(v), "a coordinate is not a finite number"};
  }
  return Unit{};
}

/// Eq. 6 inverted: from model units to those of the FAPU along each axis; with the missing unit, if one is needed.
struct InUnits {
  glm::dvec3 value{0.0};
  std::optional<FapuUnit> missing;
};

InUnits in_units(FeaturePointId point, const glm::dvec3& moved, const Fapu& fapu) {
  InUnits result;
  for (int axis = 0; axis < 3; ++axis) {
    if (moved[axis] == 0.0) continue;
    const FapuUnit unit = fapu_of(point, axis);
    if (const auto length = fapu[unit]) {
      result.value[axis] = moved[axis] / *length;
    } else if (!result.missing) {
      result.missing = unit;
    }
  }
  return result;
}

/// A point with a component without a unit moves if any other component does, or if the length of the unknown ones is
/// more than rounding.
bool is_at_rest(const InUnits& units, double least) {
  if (units.missing) return false;
  const glm::dvec3 size = glm::abs(units.value);
  return std::max({size.x, size.y, size.z}) < least || units.value == glm::dvec3(0.0);
}

Status check_size(FeaturePointId point, const glm::dvec3& units) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(units[axis]) <= most_set_units) continue;
    const auto unit = fapu_unit_names[static_cast<std::size_t>(fapu_of(point, axis))];
    return Error{ErrorCode::out_of_range, "/expression",
                 "feature point " + to_string(point) + " moves by more than " +
                     std::to_string(static_cast<int>(most_set_units / 1024.0)) + " " + std::string(unit) +
                     "0: check that both meshes have the same unit and the same vertex order"};
  }
  return Unit{};
}

std::string list(const std::vector<FeaturePointId>& points) {
  std::string text;
  for (const FeaturePointId point : points) text.append(text.empty() ? "" : ", ").append(to_string(point));
  return text;
}

}  // namespace

Result<Extraction> extract_displacements(const FeaturePointSet& points, const Fapu& fapu,
                                         std::span<const glm::vec3> neutral, std::span<const glm::vec3> expression,
                                         const ExtractOptions& options) {
  if (const Status status = check_options(options); !status) return status.error();
  if (const Status status = check_shapes(neutral, expression); !status) return status.error();
  Extraction result;
  HeadMotion motion;
  if (options.align) {
    const auto found = find_head_motion(neutral, expression);
    if (!found) {
      return Error{ErrorCode::invalid_argument, "/align",
                   "the motion of the head cannot be determined: too few vertices move rigidly"};
    }
    motion = *found;
    result.removed = RemovedMotion{motion.degrees(), glm::length(motion.still - motion.moved)};
  }
  std::array<bool, feature_point_count> is_marked{};
  for (const FeaturePoint& point : points) {
    is_marked[point.id.value()] = true;
    if (!point.vertex) {
      result.bare.push_back(point.id);
      continue;
    }
    const std::uint32_t vertex = point.vertex->value();
    assert(vertex < neutral.size());
    const glm::dvec3 before(neutral[vertex]);
    const glm::dvec3 after = options.align ? motion.undo(expression[vertex]) : glm::dvec3(expression[vertex]);
    const InUnits units = in_units(point.id, (after - before) / options.strength, fapu);
    if (const Status status = check_size(point.id, units.value); !status) return status.error();
    if (units.missing) {
      result.skipped.push_back({point.id, *units.missing});
    } else if (is_at_rest(units, options.least)) {
      result.at_rest.push_back(point.id);
    } else {
      result.displacements.push_back({point.id, glm::vec3(units.value)});
    }
  }
  for (std::size_t id = 0; id < feature_point_count; ++id) {
    if (!is_marked[id]) result.unmarked.emplace_back(static_cast<std::uint8_t>(id));
  }
  if (result.displacements.empty()) {
    const auto reasons = explain(result);
    return Error{ErrorCode::empty, "/expression",
                 "the expression moves none of the marked feature points" +
                     (result.skipped.empty() ? std::string() : ": " + reasons.front())};
  }
  return result;
}

std::vector<std::string> explain(const Extraction& extraction) {
  std::vector<std::string> sentences;
  for (std::size_t unit = 0; unit < fapu_unit_count; ++unit) {
    std::vector<FeaturePointId> points;
    for (const MissingUnit& missing : extraction.skipped) {
      if (static_cast<std::size_t>(missing.unit) == unit) points.push_back(missing.point);
    }
    if (points.empty()) continue;
    sentences.push_back("omitted, because " + std::string(fapu_unit_names[unit]) +
                        " of this head is unknown: " + list(points));
  }
  if (!extraction.bare.empty()) sentences.push_back("omitted, because they have no vertex: " + list(extraction.bare));
  if (!extraction.unmarked.empty()) sentences.push_back("not marked on this head: " + list(extraction.unmarked));
  return sentences;
}

}  // namespace semblante

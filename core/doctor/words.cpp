#include "core/doctor/words.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace semblante {

std::string count_of(std::size_t count, std::string_view one, std::string_view many) {
  return std::to_string(count) + " " + std::string(count == 1 ? one : many);
}

std::string list_of(std::span<const FeaturePointId> ids) {
  std::string text;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (i > 0) text += i + 1 == ids.size() ? " and " : ", ";
    text += to_string(ids[i]);
  }
  return text;
}

std::string percent(double share) { return std::to_string(std::lround(share * 100.0)) + " %"; }

Place place_of(const Model& model, const Surface& surface, VertexSample vertices) {
  Place place;
  if (!vertices.vertices.empty()) {
    const auto part_of = [&](VertexId v) { return surface.part_of[surface.surface_of[v.value()].value()]; };
    const VertexId first = vertices.vertices.front();
    const bool together = std::all_of(vertices.vertices.begin(), vertices.vertices.end(),
                                      [&](VertexId v) { return part_of(v) == part_of(first); });
    if (together && vertices.count == vertices.vertices.size()) place.part = part_of(first);
    place.position = glm::dvec3(model.positions[first.value()]);
  }
  place.vertices = std::move(vertices);
  return place;
}

}  // namespace semblante

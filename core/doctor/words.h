#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/doctor/finding.h"
#include "core/geometry/surface.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

// Helpers for the texts and places of findings.

/// "1 triangle has", "5 triangles have".
std::string count_of(std::size_t count, std::string_view one, std::string_view many);
/// "2.2, 2.3 and 8.1".
std::string list_of(std::span<const FeaturePointId> ids);
/// "12 %".
std::string percent(double share);

/// The place of these vertices: their part, if they are all on one, and the first of them.
Place place_of(const Model& model, const Surface& surface, VertexSample vertices);

/// Whether a surface vertex is on a part of that role. `parts` by PartId.
inline bool is_skin(const Surface& surface, std::span<const Part> parts, std::uint32_t surface_vertex) {
  return parts[surface.part_of[surface_vertex].value()].role == PartRole::skin;
}

}  // namespace semblante

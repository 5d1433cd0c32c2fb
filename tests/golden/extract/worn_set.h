#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/extract/named_set.h"
#include "core/geometry/surface.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante::testing {

/// A real head, ready to wear sets.
struct RealHead {
  Model model;
  Surface surface;
  Rig rig;
};
/// With smooth weights. Throws where a file cannot be read. `shape`: another person of the same mesh, whose positions
/// it gets. `scale`: of the coordinates, to have the same head in another unit.
RealHead read_real_head(const std::filesystem::path& model, const std::filesystem::path& points,
                        const std::filesystem::path& shape = {}, double scale = 1.0);

std::vector<std::uint8_t> read_bytes(const std::filesystem::path& file);

/// How far each file vertex goes when the head wears the set by FAP 2 at full intensity: library slot, Eq. 5 to 7.
std::vector<glm::dvec3> wear(const RealHead& head, const NamedSet& set);
/// The same for displacements of the points in model units, as they are.
std::vector<glm::dvec3> wear_model_units(const RealHead& head, const std::vector<Displacement>& displacements);

}  // namespace semblante::testing

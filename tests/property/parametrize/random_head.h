#pragma once

#include <cstdint>
#include <random>

#include "core/types/feature_points.h"
#include "core/types/model.h"

namespace semblante::testing {

/// What may go wrong with a mesh, for meshes that must not mind.
struct Roughness {
  bool seams = false;       ///< every triangle may get vertices of its own at the same places
  bool duplicates = false;  ///< triangles given twice
  bool degenerate = false;  ///< triangles with a vertex twice, or with two vertices at one place
  bool fins = false;        ///< further triangles on inner edges
  bool loose = false;       ///< vertices that no triangle uses, a second part
};

/// A landscape of `side` x `side` squares, coordinates multiples of 1/64, so that moving and doubling it is exact in
/// float32. `heights`: how many steps its vertices go up; 0 makes a flat symmetric grid full of exact ties.
Model make_landscape(std::mt19937& random, std::uint32_t side, int heights, const Roughness& roughness = {});

/// `count` different feature points at random vertices.
FeaturePointSet mark_points(std::mt19937& random, const Model& model, std::size_t count);

}  // namespace semblante::testing

#pragma once

#include <map>
#include <string>

#include "deploy/sample_head/half_mesh.h"
#include "deploy/sample_head/traits.h"

namespace semblante::sample_head_detail {

/// The left half of the skin with everything that is one surface with it: face, lids and eye sockets, lips and mouth
/// bag, nostrils, ear, neck.
struct Skin {
  HalfMesh mesh;
  std::map<std::string, int, std::less<>> marks;  ///< FPs that are known by construction, by FP id
};

Skin make_skin(const SampleHeadTraits& traits);

}  // namespace semblante::sample_head_detail

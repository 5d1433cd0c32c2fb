#pragma once

#include <map>
#include <string>

#include "deploy/sample_head/half_mesh.h"

namespace semblante::sample_head_detail {

/// The control cage of the left half of the skin: about 170 quads with holes for eye, mouth, nostril and ear, and a
/// border at the neck. `names` gives the vertices to which other parts are attached, by name; subdivision does
/// not renumber them.
struct SkinCage {
  HalfMesh mesh;
  std::map<std::string, int, std::less<>> names;

  [[nodiscard]] int operator[](std::string_view name) const { return names.find(name)->second; }
};

SkinCage make_skin_cage();

}  // namespace semblante::sample_head_detail

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "deploy/sample_head/half_mesh.h"

namespace semblante::sample_head_detail {

struct BodyPart {
  std::string name;
  enum class Look : std::uint8_t { skin, shirt, trousers } look = Look::shirt;
  HalfMesh mesh;
};

/// What a body has below the shirt of the bust: torso, sleeves, hands, trousers and shoes, as rounded tubes that
/// overlap. A figure of seven and a half heads with hanging arms.
std::vector<BodyPart> make_body_parts();

/// A place in the skin's texture without features of the face.
Vec2 bare_skin_uv();

}  // namespace semblante::sample_head_detail

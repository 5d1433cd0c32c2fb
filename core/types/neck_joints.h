#pragma once

#include <optional>
#include <string>

#include <glm/vec3.hpp>

namespace semblante {

/// A joint of a skin.
struct SkinJoint {
  std::string name;          ///< as in the file, printable
  glm::vec3 position{0.0F};  ///< at rest, in the axes and unit of Model::positions
};

/// Where the head of a file's skeleton turns. Both are hints: a file may name anything so.
struct NeckJoints {
  std::optional<SkinJoint> neck;  ///< the lowest one of the neck
  std::optional<SkinJoint> head;
};

}  // namespace semblante

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/kernel/semblante_kernel.h"
#include "core/types/result.h"
#include "protocol/package/packed_face.h"

namespace semblante {

/// A joint of the skin. Feature points only translate, eyes turn and translate, pupils scale, the head turns.
struct FaceJoint {
  enum class Kind : std::uint8_t { head, eye, pupil, point };
  Kind kind = Kind::head;
  std::string name;
  std::optional<std::size_t> parent;         ///< empty: the head, which is the first
  glm::vec3 place{0.0F};                     ///< on the neutral face
  glm::quat facing{1.0F, 0.0F, 0.0F, 0.0F};  ///< likewise; only pupils are turned: z along the iris' axis
  std::size_t index = 0;                     ///< eye and pupil: 0 left, 1 right; point: the FeaturePointId's value
  /// Of a pupil that grows to 1 + s of its radius: its z axis is scaled by 1 + 2 s sink[0].x + s s sink[1].x, and it
  /// goes along it by 2 s sink[0].y + s s sink[1].y.
  std::array<glm::vec2, 2> sink{glm::vec2(0.0F), glm::vec2(0.0F)};
  float gain = 1.0F;  ///< of a point: moves that many times its displacement
};

/// How a joint stands in a pose, relative to its parent.
struct JointTransform {
  glm::vec3 translation{0.0F};
  glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
  glm::vec3 scale{1.0F};
};

/// Eq. 7 as a skin. A row of weights that sum to s moves its vertex by the sum of w * d; the shares of a skin sum to
/// one. What is missing is the head's, which no FAP moves but the turns that move all. Where s is more than one (a
/// tongue has its own points and the jaw's) the row goes to joints that move twice as far, with half the weight.
struct FaceSkin {
  std::vector<FaceJoint> joints;
  std::size_t influences = 4;         ///< per vertex, a multiple of 4
  std::vector<std::uint8_t> joint;    ///< #V by influences; 0 where the share is 0
  std::vector<std::uint16_t> share;   ///< #V by influences, falling; a row sums to 65535
  std::size_t cut_vertices = 0;       ///< that have more influences than were wanted
  std::vector<std::string> warnings;  ///< in words
};

/// `influences`: 4, 8, 12 or 16. At most that many are written, fewer where no vertex has as many. `unsupported`
/// for a table that no skin of 256 joints can say.
Result<FaceSkin> make_face_skin(const PackedFace& face, int influences);

JointTransform joint_transform(const FaceSkin& skin, std::size_t joint, const semblante_pose& pose);

/// Takes the neutral face's coordinates to the joint's own.
glm::mat4 inverse_bind(const FaceJoint& joint);

/// Skins as a viewer does, with the first `influences` of each vertex, made to sum to one again. `positions`: #V.
void skin_positions(const FaceSkin& skin, std::span<const glm::vec3> rest, const semblante_pose& pose,
                    std::size_t influences, std::span<glm::vec3> positions);

}  // namespace semblante

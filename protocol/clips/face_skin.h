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

/// A joint of the skin. Feature points only translate, eyes turn and translate, pupils scale, lids and head turn, the
/// body stays.
struct FaceJoint {
  enum class Kind : std::uint8_t { head, eye, pupil, lid, point, body };
  Kind kind = Kind::head;
  std::string name;
  std::optional<std::size_t> parent;         ///< empty: the root, which is the body, else the head
  glm::vec3 place{0.0F};                     ///< position on the neutral face
  glm::quat facing{1.0F, 0.0F, 0.0F, 0.0F};  ///< on the neutral face; only pupils are rotated: z along the axis
  /// Eye and pupil: 0 left, 1 right. Lid: 0 left upper, 1 left lower, 2 and 3 those of the right eye. Point: the
  /// FeaturePointId's value.
  std::size_t index = 0;
  /// Of a pupil. If its radius grows by the factor 1 + s, the joint is scaled along its z axis by
  /// 1 + 2 s sink[0].x + s^2 sink[1].x and moved along that axis by 2 s sink[0].y + s^2 sink[1].y.
  std::array<glm::vec2, 2> sink{glm::vec2(0.0F), glm::vec2(0.0F)};
  float gain = 1.0F;  ///< of a point: factor of its displacement
};

/// The transform of a joint in a pose, relative to its parent.
struct JointTransform {
  glm::vec3 translation{0.0F};
  glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
  glm::vec3 scale{1.0F};
};

/// Eq. 7 as a skin. A row of weights that sum to s moves its vertex by the sum of w * d; the shares of a skin sum to
/// one. The rest belongs to the head, which moves only by rotations of the whole head, and, on the neck and below it,
/// to the body. Lids turn about the eye's pivot. If
/// s is more than one (a tongue has its own points and the jaw's) the row uses joints with twice the displacement and
/// half the weight.
struct FaceSkin {
  std::vector<FaceJoint> joints;
  std::size_t influences = 4;         ///< per vertex, a multiple of 4
  std::vector<std::uint8_t> joint;    ///< #V by influences; 0 where the share is 0
  std::vector<std::uint16_t> share;   ///< #V by influences, decreasing; a row sums to 65535
  std::size_t cut_vertices = 0;       ///< number of vertices with more influences than the maximum
  std::vector<std::string> warnings;  ///< in words
};

/// `influences`: the largest number of joints that move one vertex: 4, 8, 12 or 16; fewer are written if no vertex has
/// that many. Error `unsupported`: the weight table needs more than 256 joints.
Result<FaceSkin> make_face_skin(const PackedFace& face, int influences);

JointTransform joint_transform(const FaceSkin& skin, std::size_t joint, const semblante_pose& pose);

/// The transform from the neutral face's coordinates to those of the joint.
glm::mat4 inverse_bind(const FaceJoint& joint);

/// Applies the skin as a viewer does, with the first `influences` of each vertex, normalized to the sum one.
/// `positions`: #V.
void skin_positions(const FaceSkin& skin, std::span<const glm::vec3> rest, const semblante_pose& pose,
                    std::size_t influences, std::span<glm::vec3> positions);

}  // namespace semblante

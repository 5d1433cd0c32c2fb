#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "core/types/feature_point_id.h"
#include "deploy/sample_head/traits.h"

namespace semblante {

/// One primitive of the sample head: indexed triangles, arrays of equal length #V. Metres, MPEG-4 frame.
struct SampleHeadMesh {
  std::string name;
  std::size_t material = 0;  ///< index into SampleHead::materials
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> uvs;  ///< origin top left
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<std::uint8_t, 4>> joints;  ///< #V, indices into SampleHead::joints; empty without a skeleton
  std::vector<glm::vec4> joint_weights;             ///< #V, sum 1
};

struct SampleHeadImage {
  std::string name;
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< height by width by 3, sRGB
};

struct SampleHeadMaterial {
  std::string name;
  glm::vec4 base_color{1.0F};  ///< linear
  float roughness = 0.6F;
  std::optional<std::size_t> image;  ///< index into SampleHead::images
  bool double_sided = false;
};

struct SampleHeadPoint {
  FeaturePointId id;
  std::optional<std::uint32_t> vertex;  ///< counted over all meshes in order, as a reader of the GLB counts them
  glm::vec3 position{0.0F};
};

/// A joint of the skeleton in its rest pose, which has no rotations.
struct SampleHeadJoint {
  std::string name;
  int parent = -1;  ///< index into SampleHead::joints, less than the joint's own; -1: the root
  glm::vec3 position{0.0F};
};

/// A morph target: displacements of the vertices, counted over all meshes in order.
struct SampleHeadTarget {
  std::string name;
  std::vector<glm::vec3> displacements;
};

/// The project's own head: a neutral face in the MPEG-4 frame with its feature points.
struct SampleHead {
  std::string name = "sample-head";  ///< of its files, without an extension
  bool is_symmetric = true;
  std::vector<SampleHeadMesh> meshes;
  std::vector<SampleHeadMaterial> materials;
  std::vector<SampleHeadImage> images;
  std::vector<SampleHeadPoint> points;    ///< rising ids; all 84, but for a scan
  std::vector<SampleHeadJoint> joints;    ///< of a body
  std::vector<SampleHeadTarget> targets;  ///< none as made; the writer writes those that are added
};

/// Builds the head from tables and formulas. Deterministic; exactly symmetric in x, but for a scan.
SampleHead make_sample_head(const SampleHeadTraits& traits = {});

}  // namespace semblante

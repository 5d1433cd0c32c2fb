#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "core/types/color.h"
#include "core/types/example.h"
#include "core/types/neck_joints.h"

namespace semblante {

/// Three corner indices, counter-clockwise seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

/// An encoded image: the bytes as in the file, or re-encoded by the import if clients cannot show the file's format.
struct Image {
  std::string mime_type;  ///< "image/png" or "image/jpeg"
  std::vector<std::uint8_t> bytes;
};

/// The subset of glTF's metallic-roughness material that a face uses.
struct Material {
  std::string name;
  glm::vec4 base_color{1.0F};  ///< linear RGBA
  int base_color_image = -1;   ///< index into Model::images, -1: none
  int normal_image = -1;       ///< index into Model::images, -1: none
  /// The file's base colour image cannot be read; a default material of the part's role is shown instead.
  bool is_color_lost = false;
  float metallic = 0.0F;
  float roughness = 0.8F;
  float alpha_cutoff = 0.5F;  ///< for alpha_mode == mask
  enum class AlphaMode { opaque, mask, blend } alpha_mode = AlphaMode::opaque;
  bool double_sided = false;
};

/// Consecutive triangles with one name and one material: a glTF primitive, an OBJ group.
struct Primitive {
  std::string name;
  int material = -1;  ///< index into Model::materials, -1: none
  std::uint32_t first_triangle = 0;
  std::uint32_t triangle_count = 0;
  /// Model::colors are a part of its look: they are multiplied, as linear light, with the material's base colour.
  bool has_colors = false;
};

/// An imported head: indexed triangles over *file vertices*, with separate indices for UVs and normals as in OBJ.
/// Positions are those of the file (float32), transformed to MPEG-4 axes by the inverse of `to_file_frame`. In a model
/// from glTF, uv_triangles equals triangles.
struct Model {
  std::vector<glm::vec3> positions;  ///< #V
  std::vector<Triangle> triangles;   ///< #T by 3, into positions

  std::vector<glm::vec2> uvs;          ///< #UV or empty; origin top left, as glTF
  std::vector<Triangle> uv_triangles;  ///< #T by 3 into uvs, or empty; `no_index` where a corner has none

  std::vector<glm::vec3> normals;          ///< #N or empty, unit length
  std::vector<Triangle> normal_triangles;  ///< #T by 3 into normals, or empty; `no_index` where a corner has none

  std::vector<Color8> colors;  ///< #V, or empty; white at vertices of no primitive that has_colors

  std::vector<Primitive> primitives;  ///< cover all triangles, in order
  std::vector<Material> materials;
  std::vector<Image> images;

  std::vector<Example> examples;  ///< morph targets; empty in most models

  NeckJoints neck_joints;  ///< empty without a skeleton

  /// Transforms positions to the axes and unit of the file. Identity if the file has MPEG-4 axes.
  glm::mat4 to_file_frame{1.0F};
  std::string format;                 ///< "glb", "gltf", "obj", "ply", "stl"
  std::vector<std::string> warnings;  ///< repairs and omissions of the import, as sentences

  static constexpr std::uint32_t no_index = 0xFFFFFFFFU;
};

}  // namespace semblante

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "clients/native/render/camera.h"
#include "clients/native/render/look.h"
#include "clients/native/render/smooth_normals.h"
#include "core/types/model.h"
#include "core/types/result.h"
#include "core/types/rig.h"

namespace semblante::render {

/// A decoded image: rows from the top, four bytes per pixel, sRGB and straight alpha.
struct Texture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;
};

/// Triangles drawn with one look.
struct Run {
  Look look;
  int texture = -1;  ///< index into Scene::textures
  std::uint32_t first_triangle = 0;
  std::uint32_t triangle_count = 0;
};

/// A model laid out for drawing: one vertex for each triple of a file vertex, a UV and a normal.
struct Scene {
  std::vector<glm::vec3> rest;             ///< #V: file vertices of the neutral head
  std::vector<std::uint32_t> file_vertex;  ///< #R: the file vertex with the position of a drawn vertex
  std::vector<glm::vec2> uvs;              ///< #R
  std::vector<Color8> colors;              ///< #R; white leaves the look as it is
  std::vector<Triangle> triangles;         ///< #T, drawn vertices
  std::vector<Run> runs;
  std::vector<Texture> textures;
  SmoothNormals normals;  ///< of the drawn vertices
  Subjects subjects;
  std::vector<std::string> warnings;  ///< images that could not be decoded
};

struct SceneOptions {
  std::span<const FeaturePoint> points;      ///< for the close-ups; may be empty
  std::span<const PartRole> role_of_vertex;  ///< #V or empty: identifies eyes and teeth of a model without names
};

/// Errors: empty (no triangles), out_of_range (an index beyond its array), not_finite (a position).
Result<Scene> build_scene(const Model& model, const SceneOptions& options = {});

}  // namespace semblante::render

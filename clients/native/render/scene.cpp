#include "clients/native/render/scene.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <stb/stb_image.h>

#include "clients/native/render/eyeballs.h"

namespace semblante::render {
namespace {

constexpr int max_texture_side = 8192;

Result<Unit> check(const Model& model) {
  if (model.triangles.empty() || model.positions.empty()) {
    return Error{ErrorCode::empty, "triangles", "the model has no triangles or no vertices"};
  }
  for (const glm::vec3& p : model.positions) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      return Error{ErrorCode::not_finite, "positions", "a position is not a finite number"};
    }
  }
  for (const Triangle& triangle : model.triangles) {
    if (std::max({triangle[0], triangle[1], triangle[2]}) >= model.positions.size()) {
      return Error{ErrorCode::out_of_range, "triangles", "a triangle refers to a vertex that does not exist"};
    }
  }
  for (const Primitive& primitive : model.primitives) {
    if (primitive.first_triangle > model.triangles.size() ||
        primitive.triangle_count > model.triangles.size() - primitive.first_triangle ||
        primitive.material >= static_cast<int>(model.materials.size())) {
      return Error{ErrorCode::out_of_range, "primitives",
                   "a primitive refers to triangles or a material that do not exist"};
    }
  }
  if (!model.colors.empty() && model.colors.size() != model.positions.size()) {
    return Error{ErrorCode::mismatch, "colors", "must have one entry for each vertex"};
  }
  if (!model.uv_triangles.empty() && model.uv_triangles.size() != model.triangles.size()) {
    return Error{ErrorCode::mismatch, "uv_triangles", "must have one entry for each triangle"};
  }
  if (!model.normal_triangles.empty() && model.normal_triangles.size() != model.triangles.size()) {
    return Error{ErrorCode::mismatch, "normal_triangles", "must have one entry for each triangle"};
  }
  return Unit{};
}

std::optional<Texture> decode(const Image& image) {
  Texture texture;
  int channels = 0;
  const auto size = static_cast<int>(image.bytes.size());
  if (stbi_info_from_memory(image.bytes.data(), size, &texture.width, &texture.height, &channels) == 0 ||
      texture.width > max_texture_side || texture.height > max_texture_side) {
    return std::nullopt;
  }
  stbi_uc* pixels =
      stbi_load_from_memory(image.bytes.data(), size, &texture.width, &texture.height, &channels, STBI_rgb_alpha);
  if (pixels == nullptr) {
    return std::nullopt;
  }
  texture.rgba.assign(pixels, pixels + static_cast<std::size_t>(texture.width) * texture.height * 4);
  stbi_image_free(pixels);
  return texture;
}

/// Roles may cut a primitive into pieces: runs of triangles whose first corner has the same role.
template <class Emit>
void for_each_piece(const Model& model, const SceneOptions& options, Emit emit) {
  std::vector<Primitive> primitives = model.primitives;
  if (primitives.empty()) {
    primitives.push_back({"", -1, 0, static_cast<std::uint32_t>(model.triangles.size())});
  }
  const bool roles = options.role_of_vertex.size() == model.positions.size();
  for (const Primitive& primitive : primitives) {
    const std::uint32_t end = primitive.first_triangle + primitive.triangle_count;
    for (std::uint32_t first = primitive.first_triangle; first < end;) {
      const auto role_at = [&](std::uint32_t t) {
        return roles ? std::optional(options.role_of_vertex[model.triangles[t][0]]) : std::nullopt;
      };
      std::uint32_t last = first + 1;
      while (last < end && role_at(last) == role_at(first)) {
        ++last;
      }
      emit(primitive, role_at(first), first, last - first);
      first = last;
    }
  }
}

}  // namespace

Result<Scene> build_scene(const Model& model, const SceneOptions& options) {
  if (auto checked = check(model); !checked) {
    return std::move(checked).error();
  }
  std::vector<Run> runs;
  std::vector<std::uint8_t> group(model.triangles.size());
  std::vector<bool> is_eye(model.triangles.size());
  std::vector<int> texture_of_image(model.images.size(), -2);  // -2: not looked at yet
  std::vector<Texture> textures;
  std::vector<std::string> warnings;
  for_each_piece(
      model, options,
      [&](const Primitive& primitive, std::optional<PartRole> role, std::uint32_t first, std::uint32_t count) {
        Run run{look_of(model, primitive, role), -1, first, count};
        const int image = run.look.image;
        if (image >= 0 && image < static_cast<int>(model.images.size())) {
          int& texture = texture_of_image[static_cast<std::size_t>(image)];
          if (texture == -2) {
            if (auto decoded = decode(model.images[static_cast<std::size_t>(image)])) {
              texture = static_cast<int>(textures.size());
              textures.push_back(std::move(*decoded));
            } else {
              texture = -1;
              warnings.push_back("image " + std::to_string(image) +
                                 " could not be decoded; the surface is drawn without it");
            }
          }
          run.texture = texture;
        }
        std::fill_n(group.begin() + first, count, static_cast<std::uint8_t>(run.look.substance));
        std::fill_n(is_eye.begin() + first, count, run.look.substance == Substance::eyeball);
        if (!runs.empty() && role && runs.back().first_triangle + runs.back().triangle_count == first &&
            runs.back().texture == run.texture && runs.back().look.substance == run.look.substance &&
            runs.back().look.color == run.look.color && runs.back().look.alpha_mode == run.look.alpha_mode) {
          runs.back().triangle_count += count;
        } else {
          runs.push_back(run);
        }
      });

  Scene scene{.rest = model.positions,
              .file_vertex = {},
              .uvs = {},
              .colors = {},
              .triangles = {},
              .runs = std::move(runs),
              .textures = std::move(textures),
              .normals = {},
              .subjects = {},
              .warnings = std::move(warnings)};

  std::map<Triangle, std::uint32_t> drawn;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> own_normals;
  scene.triangles.resize(model.triangles.size());
  Box all;
  const auto attribute = [&](const std::vector<Triangle>& of_triangle, std::size_t t, std::size_t corner) {
    return of_triangle.empty() ? Model::no_index : of_triangle[t][corner];
  };
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = model.triangles[t][corner];
      const std::uint32_t uv = attribute(model.uv_triangles, t, corner);
      const std::uint32_t normal = attribute(model.normal_triangles, t, corner);
      const auto [entry, is_new] =
          drawn.try_emplace({vertex, uv, normal}, static_cast<std::uint32_t>(scene.file_vertex.size()));
      if (is_new) {
        scene.file_vertex.push_back(vertex);
        scene.uvs.push_back(uv < model.uvs.size() ? model.uvs[uv] : glm::vec2(0.0F));
        scene.colors.push_back(model.colors.empty() ? white : model.colors[vertex]);
        positions.push_back(model.positions[vertex]);
        own_normals.push_back(normal < model.normals.size() ? model.normals[normal] : glm::vec3(0.0F));
        all.add(model.positions[vertex]);
      }
      scene.triangles[t][corner] = entry->second;
    }
  }
  scene.normals = SmoothNormals(positions, std::move(own_normals), scene.triangles, group);
  scene.subjects = find_subjects(all, options.points, find_eyeballs(model.positions, model.triangles, is_eye));
  return scene;
}

}  // namespace semblante::render

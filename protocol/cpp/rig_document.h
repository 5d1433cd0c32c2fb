#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "core/tables/mpeg4.h"
#include "core/types/articulation.h"
#include "core/types/companion.h"
#include "core/types/fapu.h"
#include "core/types/feature_points.h"
#include "core/types/result.h"
#include "core/types/rig.h"
#include "protocol/cpp/sha256.h"

namespace semblante {

/// rig.json: all data of a face except vertices and weights. Lengths in model units, axes of MPEG-4.
struct RigDocument {
  /// Draco unique ids of the attributes of mesh.drc; empty: the mesh has no such attribute.
  struct Attributes {
    std::optional<std::uint32_t> position, normal, uv, material, file_vertex, color;
  };
  struct Mesh {
    Sha256 sha256{};
    std::uint32_t vertices = 0;
    std::uint32_t triangles = 0;
    std::uint64_t bytes = 0;
    Attributes attributes;
  };
  struct Weights {
    Sha256 sha256{};
    std::uint64_t bytes = 0;
    int bits = 12;
    std::uint32_t max_influences = 0;
    double mean_influences = 0.0;
    double max_error = 0.0;  ///< largest quantization error of a weight
  };
  struct Point {
    FeaturePointId id;
    std::optional<std::uint32_t> vertex;  ///< of the decoded mesh
    glm::vec3 position{0.0F};
  };
  struct Displacement {
    FeaturePointId id;
    glm::vec3 by{0.0F};  ///< at full intensity
  };
  struct DisplacementSet {
    std::string name;
    std::vector<Displacement> displacements;  ///< ids rise
  };
  struct PartInfo {
    std::string name;
    PartRole role = PartRole::skin;
    std::uint32_t vertices = 0;
    std::uint32_t triangles = 0;
  };
  struct MaterialInfo {
    std::string name;
    glm::vec4 base_color{1.0F};  ///< linear RGBA
    float metallic = 0.0F;
    float roughness = 0.8F;
    enum class AlphaMode : std::uint8_t { opaque, mask, blend } alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5F;
    bool double_sided = false;
    std::optional<Sha256> base_color_image;
    std::optional<Sha256> normal_image;
  };
  struct ImageInfo {
    Sha256 sha256{};
    std::string mime_type;
    std::uint64_t bytes = 0;
  };

  /// One package of a face: the full mesh (lod 0) or a level of detail.
  struct Level {
    std::uint32_t vertices = 0;
    std::uint32_t triangles = 0;
    std::uint64_t bytes = 0;  ///< total size of mesh.drc and weights
  };

  std::string name;
  std::uint32_t lod = 0;      ///< the level of this package
  std::vector<Level> levels;  ///< by lod; empty: the face has only this package
  Mesh mesh;
  Weights weights;
  Fapu fapu;  ///< already divided by 1024
  std::vector<Point> feature_points;
  std::array<glm::vec3, 2> eye_pivots{glm::vec3(0.0F), glm::vec3(0.0F)};  ///< left, right
  glm::vec3 head_pivot{0.0F};
  std::array<std::optional<Iris>, 2> irises;  ///< left, right; empty: FAP 29 or 30 does nothing
  std::optional<Tongue> tongue;               ///< empty: FAP 47 does nothing
  std::vector<PartInfo> parts;
  std::array<std::optional<Lids>, 2> lids;  ///< left, right; empty: the lids move by the sum of step 4 alone
  std::vector<Companion> companions;
  double viseme_share = 0.85;                ///< of Eq. 5
  double articulation = usual_articulation;  ///< the multiple of the usual opening of the jaw that `visemes` contain
  std::array<DisplacementSet, mpeg4::viseme_count> visemes;          ///< entry 0 "sil"
  std::array<DisplacementSet, mpeg4::expression_count> expressions;  ///< entry 0 "none", empty
  glm::vec3 bounds_min{0.0F}, bounds_max{0.0F};
  std::vector<MaterialInfo> materials;  ///< at least one
  std::vector<ImageInfo> images;
  std::vector<std::string> warnings;
};

/// The document as JSON text. Displacements are rounded to five significant digits; every other float is exact.
std::string write_rig(const RigDocument& rig);

/// Parses and validates rig.json. Errors have the JSON pointer of the invalid member. Unknown members are skipped.
Result<RigDocument> read_rig(std::string_view json);

}  // namespace semblante

#pragma once

#include <cstddef>

namespace semblante {

/// Materials of one file; an OBJ file ignores further ones of its libraries.
inline constexpr std::size_t max_materials = 4096;

/// What an uploaded model may ask of us. Every reader checks announced sizes against these, and against the bytes that
/// are really there, before it allocates.
struct ImportLimits {
  std::size_t max_file_bytes = std::size_t{256} << 20;  ///< of the file, and of everything inflated from a zip
  std::size_t max_vertices = 2'000'000;                 ///< file vertices, and apart from them UVs and normals
  std::size_t max_triangles = 4'000'000;                ///< after polygons and strips are split
  /// Rows of morph targets that are looked at, moving or not: what examples may cost in time, and 16 bytes each at most
  /// in memory.
  std::size_t max_example_rows = 32'000'000;
  std::size_t max_image_bytes = std::size_t{64} << 20;  ///< of one texture image; all together: max_file_bytes
  /// False where positions are all that is wanted of a file: then one of vertices alone is read too, as a model without
  /// triangles.
  bool needs_triangles = true;
};

}  // namespace semblante

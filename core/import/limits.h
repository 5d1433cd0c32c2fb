#pragma once

#include <cstddef>

namespace semblante {

/// Materials of one file; further ones of the libraries of an OBJ file are ignored.
inline constexpr std::size_t max_materials = 4096;

/// Limits of an uploaded model. Every reader checks declared sizes against these limits and against the size of the
/// file before it allocates memory.
struct ImportLimits {
  std::size_t max_file_bytes = std::size_t{256} << 20;  ///< of the file, and of everything inflated from a zip
  std::size_t max_vertices = 2'000'000;                 ///< file vertices, and apart from them UVs and normals
  std::size_t max_triangles = 4'000'000;                ///< after polygons and strips are split
  /// Maximum number of examined rows of morph targets, moving or not: bounds the time of examples, and their memory to
  /// 16 bytes per row.
  std::size_t max_example_rows = 32'000'000;
  std::size_t max_image_bytes = std::size_t{64} << 20;  ///< of one texture image; all together: max_file_bytes
  /// Pixels along a side of a PNG or JPEG, which viewers decode: what graphics processors of phones take.
  std::size_t max_image_side = 8192;
  std::size_t max_image_pixels = std::size_t{1} << 24;    ///< of an image that is decoded: 4096 x 4096
  std::size_t max_decoded_pixels = std::size_t{1} << 26;  ///< of all images of a file that are decoded
  /// False if only positions are needed: then a file without triangles is also read, as a model without
  /// triangles.
  bool needs_triangles = true;
};

}  // namespace semblante

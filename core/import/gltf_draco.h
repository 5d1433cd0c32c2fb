#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/import/limits.h"
#include "core/types/model.h"
#include "core/types/result.h"

namespace draco {
class Mesh;
}

namespace semblante::import {

/// A decoded KHR_draco_mesh_compression primitive with validated face indices.
class DracoMesh {
 public:
  /// Decodes a mesh whose declared sizes are within the limits and possible for its number of bytes.
  static Result<DracoMesh> decode(std::span<const std::uint8_t> bytes, const ImportLimits& limits);

  DracoMesh(DracoMesh&&) noexcept;
  DracoMesh& operator=(DracoMesh&&) noexcept;
  ~DracoMesh();

  [[nodiscard]] std::uint32_t point_count() const;
  [[nodiscard]] std::vector<std::uint32_t> indices() const;  ///< 3 * #faces
  /// #points rows of `components` floats of the attribute with this unique id; `normalized` as its accessor says.
  [[nodiscard]] Result<std::vector<float>> floats(std::uint32_t unique_id, std::size_t components,
                                                  bool normalized) const;

 private:
  explicit DracoMesh(std::unique_ptr<draco::Mesh> mesh);
  std::unique_ptr<draco::Mesh> mesh_;
};

}  // namespace semblante::import

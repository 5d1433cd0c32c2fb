#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/types/model.h"
#include "core/types/result.h"

namespace draco {
class Mesh;
class PointAttribute;
}  // namespace draco

namespace semblante {

/// What a stream may announce and decode to.
struct DracoLimits {
  std::size_t max_points = std::numeric_limits<std::uint32_t>::max();
  std::size_t max_triangles = std::numeric_limits<std::uint32_t>::max();
};

/// A decoded triangle mesh. Attributes are read by Draco's unique id. Errors are an unknown id, values of another type
/// or number of components, points without a value, and floats that are not finite. Errors have no `where`.
class DracoMesh {
 public:
  /// Decodes untrusted bytes. Checks the numbers declared in the header against the limits and against the number of
  /// bytes. Data inside can still declare more memory than is available, which is an error too.
  static Result<DracoMesh> decode(std::span<const std::uint8_t> bytes, const DracoLimits& limits = {});

  DracoMesh(DracoMesh&&) noexcept;
  DracoMesh& operator=(DracoMesh&&) noexcept;
  ~DracoMesh();

  [[nodiscard]] std::uint32_t point_count() const;
  [[nodiscard]] std::uint32_t triangle_count() const;
  [[nodiscard]] std::vector<Triangle> triangles() const;  ///< corners are below point_count
  /// #points rows of `components` floats; whole numbers are divided by their greatest if `normalized`.
  [[nodiscard]] Result<std::vector<float>> floats(std::uint32_t unique_id, std::size_t components,
                                                  bool normalized = false) const;
  [[nodiscard]] Result<std::vector<glm::vec3>> vectors3(std::uint32_t unique_id) const;  ///< #points
  [[nodiscard]] Result<std::vector<glm::vec2>> vectors2(std::uint32_t unique_id) const;  ///< #points
  [[nodiscard]] Result<std::vector<std::uint8_t>> bytes(std::uint32_t unique_id) const { return bytes(unique_id, 1); }
  [[nodiscard]] Result<std::vector<std::uint8_t>> bytes(std::uint32_t unique_id,
                                                        std::size_t components) const;      ///< #points by components
  [[nodiscard]] Result<std::vector<Color8>> colors(std::uint32_t unique_id) const;          ///< #points
  [[nodiscard]] Result<std::vector<std::uint32_t>> numbers(std::uint32_t unique_id) const;  ///< #points

 private:
  explicit DracoMesh(std::unique_ptr<draco::Mesh> mesh);
  [[nodiscard]] Result<const draco::PointAttribute*> attribute(std::uint32_t unique_id, std::size_t components) const;
  template <class T>
  [[nodiscard]] Result<std::vector<T>> values(const draco::PointAttribute& attribute) const;
  template <class Vector>
  [[nodiscard]] Result<std::vector<Vector>> vectors(std::uint32_t unique_id) const;

  std::unique_ptr<draco::Mesh> mesh_;
};

}  // namespace semblante

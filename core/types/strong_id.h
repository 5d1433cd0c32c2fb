#pragma once

#include <compare>
#include <cstdint>
#include <functional>

namespace semblante {

/// A typed index: ids with different tags neither compare nor convert.
template <class Tag, class Int = std::uint32_t>
class StrongId {
 public:
  using value_type = Int;

  constexpr StrongId() = default;
  constexpr explicit StrongId(Int value) : value_(value) {}

  [[nodiscard]] constexpr Int value() const { return value_; }
  constexpr StrongId& operator++() {
    ++value_;
    return *this;
  }
  friend constexpr auto operator<=>(StrongId, StrongId) = default;  // NOLINT(modernize-use-nullptr): of the default

 private:
  Int value_{};
};

/// A vertex as the model file numbers it (OBJ: `v` order; glTF: primitives in order). From 0.
using VertexId = StrongId<struct VertexTag>;
/// A point of the stitched surface: one or more file vertices.
using SurfaceVertexId = StrongId<struct SurfaceVertexTag>;
/// A connected component of the stitched surface.
using PartId = StrongId<struct PartTag>;

}  // namespace semblante

template <class Tag, class Int>
struct std::hash<semblante::StrongId<Tag, Int>> {
  std::size_t operator()(semblante::StrongId<Tag, Int> id) const noexcept { return std::hash<Int>{}(id.value()); }
};

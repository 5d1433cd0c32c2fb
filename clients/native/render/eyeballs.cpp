#include "clients/native/render/eyeballs.h"

namespace semblante::render {

std::optional<std::array<Box, 2>> find_eyeballs(std::span<const glm::vec3> positions,
                                                std::span<const Triangle> triangles, const std::vector<bool>& is_eye) {
  // Shells of one eye (sclera, cornea) may have no common edges, so the two eyes are distinguished by side: relative to
  // the middle between the outermost eye vertices, which also works for a head that is not at x = 0.
  Box both;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (is_eye[t]) {
      for (const std::uint32_t v : triangles[t]) {
        both.add(positions[v]);
      }
    }
  }
  if (both.empty()) {
    return std::nullopt;
  }
  const float middle = both.centre().x;
  std::array<Box, 2> boxes;
  const auto side_of = [&](const Triangle& triangle) {
    const float x = (positions[triangle[0]].x + positions[triangle[1]].x + positions[triangle[2]].x) / 3.0F;
    return x >= middle ? std::size_t{0} : std::size_t{1};
  };
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (is_eye[t]) {
      for (const std::uint32_t v : triangles[t]) {
        boxes[side_of(triangles[t])].add(positions[v]);
      }
    }
  }
  if (boxes[0].empty() || boxes[1].empty() || boxes[0].min.x <= boxes[1].max.x) {
    return std::nullopt;  // one eye, or not a pair of eyes
  }
  return boxes;
}

}  // namespace semblante::render

#include "server/cli/ply_writer.h"

#include <bit>
#include <cassert>
#include <cstring>
#include <ostream>
#include <string>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace semblante {
namespace {

static_assert(std::endian::native == std::endian::little);

template <class Value>
void append_bytes(std::string& text, const Value& value) {
  const std::size_t at = text.size();
  text.resize(at + sizeof value);
  std::memcpy(text.data() + at, &value, sizeof value);
}

}  // namespace

void write_ply(const Model& model, std::span<const glm::vec3> positions, std::ostream& out) {
  assert(positions.size() == model.positions.size());
  const bool same_frame = model.to_file_frame == glm::mat4(1.0F);
  const glm::dmat4 to_file(model.to_file_frame);
  const bool mirrored = !same_frame && glm::determinant(glm::dmat3(to_file)) < 0.0;
  out << "ply\nformat binary_little_endian 1.0\nelement vertex " << positions.size()
      << "\nproperty float x\nproperty float y\nproperty float z\n"
      << (model.colors.empty() ? "" : "property uchar red\nproperty uchar green\nproperty uchar blue\n")
      << "element face " << model.triangles.size() << "\nproperty list uchar uint vertex_indices\nend_header\n";
  std::string bytes;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const glm::vec3 p = same_frame ? positions[v] : glm::vec3(glm::dvec3(to_file * glm::dvec4(positions[v], 1.0)));
    for (const float coordinate : {p.x, p.y, p.z}) append_bytes(bytes, coordinate);
    if (!model.colors.empty()) append_bytes(bytes, model.colors[v]);
  }
  for (const Triangle& triangle : model.triangles) {
    append_bytes(bytes, std::uint8_t{3});
    for (std::size_t i = 0; i < 3; ++i) append_bytes(bytes, triangle[mirrored ? 2 - i : i]);
  }
  out << bytes;
}

}  // namespace semblante

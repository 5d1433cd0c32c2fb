#include "server/cli/obj_writer.h"

#include <array>
#include <cassert>
#include <charconv>
#include <ostream>
#include <string>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace semblante {
namespace {

/// Collects lines and writes them in blocks.
class ObjText {
 public:
  explicit ObjText(std::ostream& out) : out_(out) {}
  ObjText(const ObjText&) = delete;
  ObjText& operator=(const ObjText&) = delete;
  ~ObjText() { out_ << text_; }

  ObjText& operator<<(std::string_view text) {
    text_ += text;
    return *this;
  }
  template <class Number>
  ObjText& number(Number value) {
    std::array<char, 32> digits{};
    text_ += ' ';
    text_.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
    return *this;
  }
  /// " v" or " v/vt", from 1.
  void corner(std::uint32_t vertex, std::uint32_t uv) {
    number(vertex + 1);
    if (uv == Model::no_index) return;
    number(uv + 1);
    text_[text_.rfind(' ')] = '/';
  }
  void end_line() {
    text_ += '\n';
    constexpr std::size_t flush_at = std::size_t{1} << 16;
    if (text_.size() < flush_at) return;
    out_ << text_;
    text_.clear();
  }

 private:
  std::ostream& out_;
  std::string text_;
};

}  // namespace

void write_obj(const Model& model, std::span<const glm::vec3> positions, std::ostream& out) {
  assert(positions.size() == model.positions.size());
  const bool same_frame = model.to_file_frame == glm::mat4(1.0F);
  const glm::dmat4 to_file(model.to_file_frame);
  const bool mirrored = !same_frame && glm::determinant(glm::dmat3(to_file)) < 0.0;
  ObjText text(out);
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const glm::vec3 p = same_frame ? positions[v] : glm::vec3(glm::dvec3(to_file * glm::dvec4(positions[v], 1.0)));
    text << "v";
    text.number(p.x).number(p.y).number(p.z);
    for (std::size_t c = 0; c < 3 && !model.colors.empty(); ++c)
      text.number(static_cast<float>(model.colors[v][c]) / 255.0F);
    text.end_line();
  }
  for (const glm::vec2& uv : model.uvs) {
    text << "vt";
    text.number(uv.x).number(1.0F - uv.y).end_line();  // v of OBJ has its origin at the bottom
  }
  for (const Primitive& primitive : model.primitives) {
    if (!primitive.name.empty()) (text << "g " << primitive.name).end_line();
    if (primitive.material >= 0) {
      const std::string& name = model.materials[static_cast<std::size_t>(primitive.material)].name;
      (text << "usemtl " << (name.empty() ? "material" + std::to_string(primitive.material) : name)).end_line();
    }
    for (std::uint32_t t = primitive.first_triangle; t < primitive.first_triangle + primitive.triangle_count; ++t) {
      text << "f";
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t c = mirrored ? 2 - i : i;
        text.corner(model.triangles[t][c], model.uv_triangles.empty() ? Model::no_index : model.uv_triangles[t][c]);
      }
      text.end_line();
    }
  }
}

}  // namespace semblante

#include "clients/native/client/mesh_writer.h"

#include <array>
#include <charconv>
#include <cstring>

namespace semblante::client {
namespace {

template <class Number>
void append(std::string& text, Number number) {
  std::array<char, 32> digits{};
  const auto [end, problem] = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  static_cast<void>(problem);  // 32 characters hold any float and any 64-bit integer
  text.append(digits.data(), end);
}

template <class Value>
void append_bytes(std::string& text, const Value& value) {
  // Copies the bytes: all supported machines are little-endian.
  std::array<char, sizeof(Value)> bytes{};
  std::memcpy(bytes.data(), &value, sizeof(Value));
  text.append(bytes.data(), bytes.size());
}

void append_point(std::string& text, const glm::vec3& p, char between) {
  append(text, p.x);
  text += between;
  append(text, p.y);
  text += between;
  append(text, p.z);
  text += '\n';
}

}  // namespace

std::string write_obj(const Model& model, std::span<const glm::vec3> positions) {
  std::string text = "# Semblante\n";
  for (std::size_t v = 0; v < positions.size(); ++v) {
    text += "v ";
    append_point(text, positions[v], ' ');
    if (model.colors.empty()) continue;
    text.pop_back();
    for (const std::uint8_t channel : model.colors[v]) {
      text += ' ';
      append(text, static_cast<float>(channel) / 255.0F);
    }
    text += '\n';
  }
  const bool uvs = !model.uvs.empty() && model.uv_triangles.size() == model.triangles.size();
  for (std::size_t i = 0; uvs && i < model.uvs.size(); ++i) {
    text += "vt ";
    append(text, model.uvs[i].x);
    text += ' ';
    append(text, 1.0F - model.uvs[i].y);  // v of OBJ has its origin at the bottom
    text += '\n';
  }
  for (const Primitive& primitive : model.primitives) {
    if (!primitive.name.empty() && primitive.name.find_first_of("\r\n") == std::string::npos) {
      text += "g " + primitive.name + '\n';
    }
    for (std::uint32_t t = primitive.first_triangle; t < primitive.first_triangle + primitive.triangle_count; ++t) {
      text += 'f';
      for (std::size_t corner = 0; corner < 3; ++corner) {
        text += ' ';
        append(text, std::uint64_t{model.triangles[t][corner]} + 1);
        if (uvs && model.uv_triangles[t][corner] != Model::no_index) {
          text += '/';
          append(text, std::uint64_t{model.uv_triangles[t][corner]} + 1);
        }
      }
      text += '\n';
    }
  }
  return text;
}

std::string write_ply(const Model& model, std::span<const glm::vec3> positions) {
  std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex ";
  append(text, positions.size());
  text += "\nproperty float x\nproperty float y\nproperty float z";
  if (!model.colors.empty()) text += "\nproperty uchar red\nproperty uchar green\nproperty uchar blue";
  text += "\nelement face ";
  append(text, model.triangles.size());
  text += "\nproperty list uchar uint vertex_indices\nend_header\n";
  for (std::size_t v = 0; v < positions.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) append_bytes(text, positions[v][axis]);
    if (!model.colors.empty()) append_bytes(text, model.colors[v]);
  }
  for (const Triangle& triangle : model.triangles) {
    text += '\3';
    for (const std::uint32_t v : triangle) {
      append_bytes(text, v);
    }
  }
  return text;
}

std::string write_table(std::span<const glm::vec3> positions) {
  std::string text = "vertex,x,y,z\n";
  for (std::size_t v = 0; v < positions.size(); ++v) {
    append(text, v);
    text += ',';
    append_point(text, positions[v], ',');
  }
  return text;
}

}  // namespace semblante::client

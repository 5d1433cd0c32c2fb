#pragma once

#include <cstring>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/unit/import/test_files.h"

namespace semblante::test {

enum Component : int { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

template <class T>
Bytes bytes_of(const std::vector<T>& values) {
  Bytes bytes(values.size() * sizeof(T));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// A glTF put together piece by piece: `json` is open to be changed, buffer 0 is the binary chunk.
class GltfWriter {
 public:
  GltfWriter() {
    json = {{"asset", {{"version", "2.0"}}},
            {"scene", 0},
            {"scenes", {{{"nodes", {0}}}}},
            {"nodes", {{{"mesh", 0}}}},
            {"meshes", {{{"primitives", {{{"attributes", nlohmann::json::object()}}}}}}}};
  }

  nlohmann::json json;

  [[nodiscard]] nlohmann::json& primitive() { return json["meshes"][0]["primitives"][0]; }

  /// Adds bytes as a buffer view, on a multiple of 4; gives its number.
  std::size_t view(const Bytes& bytes, std::size_t stride = 0) {
    while (binary_.size() % 4 != 0) binary_.push_back(0);
    nlohmann::json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
    if (stride > 0) view["byteStride"] = stride;
    binary_.insert(binary_.end(), bytes.begin(), bytes.end());
    json["bufferViews"].push_back(view);
    return json["bufferViews"].size() - 1;
  }

  std::size_t accessor(std::size_t view, Component component, std::size_t count, const char* type,
                       bool normalized = false) {
    nlohmann::json accessor = {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}};
    if (normalized) accessor["normalized"] = true;
    json["accessors"].push_back(accessor);
    return json["accessors"].size() - 1;
  }

  /// View and accessor of floats.
  std::size_t floats(const std::vector<float>& values, const char* type) {
    const std::size_t components = std::strcmp(type, "VEC2") == 0 ? 2 : std::strcmp(type, "VEC3") == 0 ? 3 : 4;
    return accessor(view(bytes_of(values)), f32, values.size() / components, type);
  }
  std::size_t indices(const std::vector<std::uint16_t>& values) {
    return accessor(view(bytes_of(values)), u16, values.size(), "SCALAR");
  }

  /// The unit quad of test_files as positions and indices of the one primitive.
  void add_quad() {
    primitive()["attributes"]["POSITION"] = floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
    primitive()["indices"] = indices({0, 1, 2, 0, 2, 3});
  }

  [[nodiscard]] Bytes glb() const {
    nlohmann::json whole = json;
    if (whole["buffers"].is_null()) whole["buffers"] = nlohmann::json::array({nlohmann::json::object()});
    whole["buffers"][0]["byteLength"] = binary_.size();
    return make_glb(whole.dump(), binary_);
  }

  [[nodiscard]] Result<Model> import(const ImportLimits& limits = {}) const {
    return import_model(glb(), ModelFormat::glb, limits);
  }

 private:
  Bytes binary_;
};

}  // namespace semblante::test

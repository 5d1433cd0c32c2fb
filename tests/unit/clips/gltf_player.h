#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace tinygltf {
class Model;
}

namespace semblante::testing {

/// A plain reader and player of skinned glTF, written from the glTF 2.0 specification alone: what a viewer does.
class GltfPlayer {
 public:
  /// Adds test failures for what is wrong with the file.
  explicit GltfPlayer(std::span<const std::uint8_t> glb);
  ~GltfPlayer();
  GltfPlayer(const GltfPlayer&) = delete;
  GltfPlayer& operator=(const GltfPlayer&) = delete;

  struct Primitive {
    int material = 0;
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> corners;
    std::size_t sets = 0;                ///< of JOINTS_n, WEIGHTS_n
    std::vector<std::uint32_t> joints;   ///< #V by 4 sets
    std::vector<std::uint32_t> weights;  ///< likewise, as the file has them, of 65535
  };
  [[nodiscard]] const std::vector<Primitive>& primitives() const { return primitives_; }
  [[nodiscard]] std::size_t animation_count() const;
  [[nodiscard]] std::size_t channel_count() const;
  [[nodiscard]] float duration() const;
  [[nodiscard]] std::string extras() const;  ///< asset.extras as JSON

  /// The skinned positions at `seconds`, of each primitive. `sets`: read at most that many sets of four, made to sum to
  /// one.
  [[nodiscard]] std::vector<std::vector<glm::vec3>> at(float seconds, std::size_t sets = 99) const;

 private:
  std::unique_ptr<tinygltf::Model> model_;
  std::vector<Primitive> primitives_;
};

}  // namespace semblante::testing

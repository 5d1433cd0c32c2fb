#include "tests/support/sample_obj.h"

#include <array>
#include <cstdio>
#include <map>

namespace semblante::testing {

std::string obj_of(const SampleHead& head) {
  std::string text;
  std::size_t count = 0;
  for (const SampleHeadMesh& mesh : head.meshes) {
    text += "g " + mesh.name + "\n";
    std::map<std::array<float, 3>, std::size_t> number;
    std::vector<std::size_t> number_of_vertex;
    for (const glm::vec3& p : mesh.positions) {
      const auto [place, is_new] = number.try_emplace({p.x + 0.0F, p.y + 0.0F, p.z + 0.0F}, count + 1);
      if (is_new) {
        ++count;
        std::array<char, 96> line{};
        std::snprintf(line.data(), line.size(), "v %.9g %.9g %.9g\n", p.x + 0.0F, p.y + 0.0F, p.z + 0.0F);
        text += line.data();
      }
      number_of_vertex.push_back(place->second);
    }
    for (const auto& t : mesh.triangles) {
      text += "f " + std::to_string(number_of_vertex[t[0]]) + " " + std::to_string(number_of_vertex[t[1]]) + " " +
              std::to_string(number_of_vertex[t[2]]) + "\n";
    }
  }
  return text;
}

}  // namespace semblante::testing

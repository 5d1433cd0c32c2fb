#include "tests/support/sample_head_model.h"

#include "deploy/sample_head/sample_head.h"

namespace semblante::testing {
namespace {

const SampleHead& head() {
  static const SampleHead made = make_sample_head();
  return made;
}

}  // namespace

Model sample_head_model() {
  Model model;
  for (const SampleHeadMesh& mesh : head().meshes) {
    const auto first = static_cast<std::uint32_t>(model.positions.size());
    Primitive primitive{mesh.name, -1, static_cast<std::uint32_t>(model.triangles.size()),
                        static_cast<std::uint32_t>(mesh.triangles.size())};
    model.positions.insert(model.positions.end(), mesh.positions.begin(), mesh.positions.end());
    for (const auto& t : mesh.triangles) model.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    model.primitives.push_back(std::move(primitive));
  }
  return model;
}

FeaturePointSet sample_head_points() {
  FeaturePointSet points;
  for (const SampleHeadPoint& point : head().points) {
    FeaturePoint placed{point.id, std::nullopt, point.position};
    if (point.vertex) placed.vertex = VertexId(*point.vertex);
    points.push_back(placed);
  }
  return points;
}

}  // namespace semblante::testing

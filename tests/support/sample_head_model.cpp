#include "tests/support/sample_head_model.h"

#include <deque>
#include <utility>

namespace semblante::testing {
namespace {

constexpr FamilyMember family[] = {
    {"sample", {}},
    {"broad", {.jaw_width = 1.10, .face_length = 0.94, .nose_length = 0.85}},
    {"long", {.jaw_width = 0.93, .face_length = 1.07, .nose_length = 1.2}},
    {"pressed lips", {.pressed_lips = true}},
    {"closed eyes", {.closed_eyes = true}},
    {"body", {.form = SampleHeadForm::body}},
    {"scan", {.form = SampleHeadForm::scan}},
};

/// Building a head takes a good part of a second and many tests want the same.
const SampleHead& head_of(const SampleHeadTraits& traits) {
  static std::deque<std::pair<SampleHeadTraits, SampleHead>> made;
  for (const auto& [built_with, head] : made) {
    if (built_with == traits) return head;
  }
  return made.emplace_back(traits, make_sample_head(traits)).second;
}

}  // namespace

std::span<const FamilyMember> sample_family() { return family; }

Model sample_head_model(const SampleHeadTraits& traits) {
  const SampleHead& head = head_of(traits);
  Model model;
  for (const SampleHeadMesh& mesh : head.meshes) {
    const auto first = static_cast<std::uint32_t>(model.positions.size());
    Primitive primitive{mesh.name, -1, static_cast<std::uint32_t>(model.triangles.size()),
                        static_cast<std::uint32_t>(mesh.triangles.size())};
    model.positions.insert(model.positions.end(), mesh.positions.begin(), mesh.positions.end());
    for (const auto& t : mesh.triangles) model.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    model.primitives.push_back(std::move(primitive));
  }
  return model;
}

FeaturePointSet sample_head_points(const SampleHeadTraits& traits) {
  const SampleHead& head = head_of(traits);
  FeaturePointSet points;
  for (const SampleHeadPoint& point : head.points) {
    FeaturePoint placed{point.id, std::nullopt, point.position};
    if (point.vertex) placed.vertex = VertexId(*point.vertex);
    points.push_back(placed);
  }
  return points;
}

}  // namespace semblante::testing

#include "tests/unit/doctor/heads.h"

#include <stdexcept>

#include "core/anatomy/part_roles.h"
#include "core/parametrize/fapu.h"
#include "core/parametrize/parametrize.h"
#include "core/parametrize/place_feature_points.h"
#include "tests/oracle/real_heads.h"

namespace semblante::testing {
namespace {

FeaturePointSet place(const Model& model, const std::vector<MarkedPoint>& marked) {
  auto points = place_feature_points(model, build_surface(model), marked, nullptr);
  if (!points) throw std::runtime_error(points.error().message);
  return *points;
}

}  // namespace

Head sample_head(const SampleHeadTraits& traits) {
  return {"sample", sample_head_model(traits), sample_head_points(traits)};
}

std::optional<Head> real_head(std::string_view name) {
  const auto faces = oracle::faces_folder();
  if (!faces) return std::nullopt;
  const std::string folder(name.substr(0, name.find(' ')));
  const auto marked = oracle::read_trusted_points(*faces / folder / (folder + ".fps.json"));
  Head head{std::string(name), {}, {}};
  if (name == "ict-facekit" || name == "ict-facekit identity") {
    head.model = oracle::read_trusted_obj(*faces / folder / "neutral.obj");
    head.points = place(head.model, marked);
    if (name == "ict-facekit") return head;
    // Another person on the same mesh; 7.1 is no vertex and would stay where the first one has it.
    head.model.positions = oracle::read_trusted_obj(*faces / folder / "identity-sample.obj").positions;
    std::erase_if(head.points, [](const FeaturePoint& p) { return !p.vertex; });
    for (FeaturePoint& point : head.points) point.position = head.model.positions[point.vertex->value()];
    return head;
  }
  const char* const file = name == "makehuman"       ? "head.obj"
                           : name == "makehuman glb" ? "head.glb"
                                                     : "face_model_with_iris.obj";
  head.model = oracle::import_head(*faces / folder / file);
  head.points = place(head.model, marked);
  return head;
}

std::optional<Head> head_named(std::string_view name) {
  for (const FamilyMember& member : sample_family()) {
    if (name == member.name) return sample_head(member.traits);
  }
  return real_head(name);
}

Report examine_with_weights(const Head& head, WeightMethod method) {
  const Surface surface = build_surface(head.model);
  ParametrizeOptions options;
  options.weights = method;
  const auto rig = parametrize(head.model, surface, head.points, options);
  if (!rig) throw std::runtime_error(rig.error().message);
  return examine(head.model, surface, *rig, method);
}

Report examine_without_weights(const Head& head) {
  const Surface surface = build_surface(head.model);
  Rig rig;
  rig.points = head.points;
  rig.fapu = compute_fapu(head.points);
  rig.parts = describe_parts(head.model, surface, head.points);
  rig.influence.offsets.assign(head.model.positions.size() + 1, 0);
  return examine(head.model, surface, rig, WeightMethod::smooth);
}

}  // namespace semblante::testing

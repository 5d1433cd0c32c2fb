#include "tests/golden/extract/worn_set.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "core/expressions/contact.h"
#include "core/expressions/kernel_rig.h"
#include "core/extract/shape.h"
#include "core/parametrize/parametrize.h"
#include "core/parametrize/place_feature_points.h"
#include "tests/oracle/real_heads.h"

namespace semblante::testing {

std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path.string() + " cannot be read");
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

RealHead read_real_head(const std::filesystem::path& model, const std::filesystem::path& points,
                        const std::filesystem::path& shape, double scale) {
  RealHead head;
  head.model = oracle::import_head(model);
  if (!shape.empty()) {
    auto positions = shape_of_file(head.model, read_bytes(shape), shape.filename().string());
    if (!positions) throw std::runtime_error(shape.string() + ": " + positions.error().message);
    head.model.positions = std::move(*positions);
  }
  for (glm::vec3& p : head.model.positions) p *= static_cast<float>(scale);
  auto marked = oracle::read_trusted_points(points);
  for (MarkedPoint& point : marked) {
    if (point.vertex)
      point.position.reset();  // those of the file are of the head it was made for
    else if (point.position)
      *point.position *= scale;
  }
  head.surface = build_surface(head.model);
  const auto placed = place_feature_points(head.model, head.surface, marked, nullptr);
  if (!placed) throw std::runtime_error(model.string() + ": " + placed.error().message);
  ParametrizeOptions options;
  options.weights = WeightMethod::smooth;
  auto rig = parametrize(head.model, head.surface, *placed, options);
  if (!rig) throw std::runtime_error(model.string() + ": " + rig.error().message);
  head.rig = std::move(*rig);
  return head;
}

std::vector<glm::dvec3> wear_model_units(const RealHead& head, const std::vector<Displacement>& displacements) {
  KernelRig kernel = make_kernel_rig(head.rig);
  const auto row = to_dense(displacements);
  std::copy(row.begin(), row.end(), kernel.expressions.begin() + static_cast<std::ptrdiff_t>(row.size()));
  semblante_frame frame{};
  frame.expression1 = 1;
  frame.intensity1 = SEMBLANTE_BLEND_MAX;
  semblante_pose pose{};
  const semblante_rig view = kernel.view();
  semblante_evaluate(&view, &frame, &pose);
  std::vector<glm::vec3> moved(head.model.positions.size());
  const semblante_face face = make_kernel_face(head.rig, &head.model.positions.front().x);
  semblante_deform(&face, &pose, &moved.front().x);
  std::vector<glm::dvec3> by;
  for (std::size_t v = 0; v < moved.size(); ++v)
    by.push_back(glm::dvec3(moved[v]) - glm::dvec3(head.model.positions[v]));
  return by;
}

std::vector<glm::dvec3> wear(const RealHead& head, const NamedSet& set) {
  return wear_model_units(head, on_face(set.view(), head.rig.fapu, head.rig.points, head.rig.lip_gaps).displacements);
}

}  // namespace semblante::testing

#include "core/extract/named_shapes.h"

#include <cstdint>

#include "core/extract/shape_names.h"
#include "core/kernel/semblante_kernel.h"

namespace semblante {
namespace {

/// A face from ARKit's shapes needs this share of the sum of its coefficients.
constexpr double most_of_arkit = 0.8;
/// Smaller coefficients of arkit_from_frame are not asked for.
constexpr float least_coefficient = 0.02F;

}  // namespace

NamedShapes::NamedShapes(const Model& model) {
  for (const Example& example : model.examples) {
    if (const auto face = face_of_shape_name(example.name)) {
      named_.try_emplace({face->kind, face->number}, &example);
    } else if (const auto shape = arkit_of_shape_name(example.name)) {
      if (arkit_[*shape] == nullptr) arkit_[*shape] = &example;
    }
  }
}

ShapeSum NamedShapes::find(SetKind kind, std::size_t number) const {
  if (const auto found = named_.find({kind, number}); found != named_.end()) return {{found->second, 1.0F}};
  return from_arkit(kind, number);
}

ShapeSum NamedShapes::from_arkit(SetKind kind, std::size_t number) const {
  semblante_frame frame{};
  if (kind == SetKind::viseme) {
    frame.viseme1 = static_cast<std::uint8_t>(number);
    frame.viseme_blend = 63;
  } else {
    frame.expression1 = static_cast<std::uint8_t>(number);
    frame.intensity1 = 63;
  }
  const ArkitCoefficients wanted = arkit_from_frame(frame);
  ShapeSum sum;
  double all = 0.0;
  double here = 0.0;
  for (std::size_t shape = 0; shape < wanted.size(); ++shape) {
    if (wanted[shape] < least_coefficient) continue;
    all += static_cast<double>(wanted[shape]);
    if (arkit_[shape] == nullptr) continue;
    here += static_cast<double>(wanted[shape]);
    sum.emplace_back(arkit_[shape], wanted[shape]);
  }
  if (!(here > 0.0) || here < most_of_arkit * all) return {};
  return sum;
}

std::string source_of(const ShapeSum& sum) {
  return sum.size() == 1 ? sum.front().first->name : std::to_string(sum.size()) + " ARKit shapes";
}

glm::vec3 displacement_of(const ShapeSum& sum, std::uint32_t vertex) {
  glm::vec3 displacement(0.0F);
  for (const auto& [example, share] : sum) displacement += share * example->at(vertex);
  return displacement;
}

}  // namespace semblante

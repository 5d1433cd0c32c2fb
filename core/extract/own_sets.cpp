#include "core/extract/own_sets.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "core/bridges/arkit.h"
#include "core/expressions/library.h"
#include "core/extract/extract.h"
#include "core/extract/shape_names.h"
#include "core/kernel/semblante_kernel.h"

namespace semblante {
namespace {

/// A viseme moves few points, because by Eq. 5 each reduces an expression there: the value of the library's visemes.
constexpr double least_of_visemes = 50.0;
constexpr double least_of_expressions = 1.0;
/// A face from ARKit's shapes needs this share of the sum of its coefficients.
constexpr double most_of_arkit = 0.8;
/// Smaller coefficients of arkit_from_frame are not asked for.
constexpr float least_coefficient = 0.02F;

/// A face as a sum of the model's shapes.
using ShapeSum = std::vector<std::pair<const Example*, float>>;

/// The model's shapes by what they show.
class NamedShapes {
 public:
  explicit NamedShapes(const Model& model) {
    for (const Example& example : model.examples) {
      if (const auto face = face_of_shape_name(example.name)) {
        named_.try_emplace({face->kind, face->number}, &example);
      } else if (const auto shape = arkit_of_shape_name(example.name)) {
        if (arkit_[*shape] == nullptr) arkit_[*shape] = &example;
      }
    }
  }

  [[nodiscard]] ShapeSum find(SetKind kind, std::size_t number) const {
    if (const auto found = named_.find({kind, number}); found != named_.end()) return {{found->second, 1.0F}};
    return from_arkit(kind, number);
  }

 private:
  [[nodiscard]] ShapeSum from_arkit(SetKind kind, std::size_t number) const {
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

  std::map<std::pair<SetKind, std::size_t>, const Example*> named_;
  std::array<const Example*, arkit_count> arkit_{};
};

std::vector<glm::vec3> shape_of(const Model& model, const ShapeSum& sum) {
  std::vector<glm::vec3> shape = model.positions;
  for (const auto& [example, share] : sum) example->add_to(shape, share);
  return shape;
}

void list(std::string& names, std::string_view name) { names.append(names.empty() ? "" : ", ").append(name); }

}  // namespace

Result<OwnSets> own_sets(const Model& model, const FeaturePointSet& points, const Fapu& fapu) {
  const NamedShapes shapes(model);
  OwnSets result;
  std::string found;
  std::string missing;
  for (const SetKind kind : {SetKind::viseme, SetKind::expression}) {
    const auto library = library_of(kind);
    ExtractOptions options;
    options.least = kind == SetKind::viseme ? least_of_visemes : least_of_expressions;
    for (std::size_t number = 1; number < library.size(); ++number) {
      const std::string name(library[number].name);
      const ShapeSum sum = shapes.find(kind, number);
      if (sum.empty()) {
        list(missing, name);
        continue;
      }
      auto extraction = extract_displacements(points, fapu, model.positions, shape_of(model, sum), options);
      if (!extraction) {
        result.words.push_back("its own shape for " + name +
                               " is left out, the library's stays: " + extraction.error().message);
        continue;
      }
      list(found, sum.size() == 1 ? name + " (" + sum[0].first->name + ")"
                                  : name + " (" + std::to_string(sum.size()) + " ARKit shapes)");
      result.sets.push_back({name, kind, std::move(extraction->displacements)});
    }
  }
  if (result.sets.empty()) {
    return Error{
        ErrorCode::missing, "/expressions",
        model.examples.empty()
            ? "own visemes and expressions need shapes of the head's own (morph targets), and the model has none"
            : "none of the " + std::to_string(model.examples.size()) +
                  " morph targets of the model is a viseme or expression by its name (viseme_PP, Fcl_MTH_A, "
                  "Fcl_ALL_Joy, happy, ...), and they are not ARKit's"};
  }
  result.words.insert(result.words.begin(), "the head wears its own " + found);
  if (!missing.empty()) result.words.push_back("it has no shapes for " + missing + ": the library's are worn");
  return result;
}

void wear_own(std::vector<NamedSet>& worn, std::vector<NamedSet> own) {
  for (NamedSet& set : own) {
    const bool is_chosen =
        std::any_of(worn.begin(), worn.end(), [&](const NamedSet& other) { return other.name == set.name; });
    if (!is_chosen) worn.push_back(std::move(set));
  }
}

}  // namespace semblante

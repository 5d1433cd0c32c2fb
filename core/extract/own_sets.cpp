#include "core/extract/own_sets.h"

#include <algorithm>
#include <utility>

#include "core/expressions/library.h"
#include "core/extract/extract.h"
#include "core/extract/named_shapes.h"

namespace semblante {
namespace {

/// A viseme moves few points, because by Eq. 5 each reduces an expression there: the value of the library's visemes.
constexpr double least_of_visemes = 50.0;
constexpr double least_of_expressions = 1.0;

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
      list(found, name + " (" + source_of(sum) + ")");
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

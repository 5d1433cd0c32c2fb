#include "core/extract/shape.h"

#include <algorithm>
#include <string>

#include "core/extract/same_mesh.h"

namespace semblante {

Result<std::vector<glm::vec3>> shape_of_target(const Model& model, std::string_view target) {
  std::vector<glm::vec3> shape = model.positions;
  if (target.empty()) return shape;
  const auto found = std::find_if(model.examples.begin(), model.examples.end(),
                                  [&](const Example& example) { return example.name == target; });
  if (found == model.examples.end()) {
    constexpr std::size_t most_named = 100;
    std::string names;
    for (std::size_t i = 0; i < model.examples.size() && i < most_named; ++i)
      names.append(i > 0 ? ", " : "").append(model.examples[i].name);
    if (model.examples.size() > most_named) names += ", ...";
    return Error{ErrorCode::missing, "",
                 "the model has no morph target of this name; " +
                     (names.empty() ? "it has no morph targets" : "it has " + names)};
  }
  found->add_to(shape);
  return shape;
}

Result<std::vector<glm::vec3>> shape_of_file(const Model& neutral, std::span<const std::uint8_t> bytes,
                                             std::string_view file_name) {
  const auto format = format_of(bytes, file_name);
  if (!format) return Error{format.error().code, "/expression", format.error().message};
  ImportLimits limits;
  limits.needs_triangles = false;
  auto model = import_model(bytes, *format, limits);
  if (!model) return model.error();
  if (model->positions.size() != neutral.positions.size()) {
    return Error{ErrorCode::mismatch, "/expression",
                 "the expression has " + std::to_string(model->positions.size()) + " vertices, the neutral head " +
                     std::to_string(neutral.positions.size()) +
                     ": both must be the same mesh with the same vertex order"};
  }
  if (const Status status = check_same_mesh(neutral.triangles, model->triangles); !status) return status.error();
  return std::move(model->positions);
}

}  // namespace semblante

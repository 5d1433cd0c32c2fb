#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "core/extract/extract.h"
#include "core/extract/set_file.h"
#include "core/extract/shape.h"
#include "core/parametrize/fapu.h"
#include "server/jobs/marked_model.h"
#include "server/jobs/worker_tasks.h"

namespace semblante::jobs {
namespace {

using Json = nlohmann::ordered_json;

Json names(const std::vector<FeaturePointId>& points) {
  Json list = Json::array();
  for (const FeaturePointId point : points) list.push_back(to_string(point));
  return list;
}

/// What is in the set and what is not.
Json describe(const Extraction& extraction) {
  Json json = {{"points", extraction.displacements.size()}, {"skipped", Json::object()}};
  for (const MissingUnit& missing : extraction.skipped)
    json["skipped"][to_string(missing.point)] = std::string(fapu_unit_names[static_cast<std::size_t>(missing.unit)]);
  json["at_rest"] = names(extraction.at_rest);
  json["at_no_vertex"] = names(extraction.bare);
  json["not_marked"] = names(extraction.unmarked);
  json["head_motion"] = nullptr;
  if (extraction.removed)
    json["head_motion"] = {{"degrees", extraction.removed->degrees}, {"distance", extraction.removed->distance}};
  return json;
}

/// The shape of a morph target; a name that is not there is a field of the request.
Result<std::vector<glm::vec3>> shape_of_field(const Model& model, const std::string& field, const std::string& target) {
  auto shape = shape_of_target(model, target);
  if (!shape) return Error{ErrorCode::invalid_argument, field, shape.error().message};
  return shape;
}

}  // namespace

Result<WorkerResult> run_extract(const WorkerRequest& request, const Progress& progress) {
  const store::ExtractionRecord& wish = *request.extraction;
  progress(0.05, "reading");
  auto model = read_model(request);
  if (!model) return model.error();
  std::vector<glm::vec3> expression;
  if (!request.expression_source.empty()) {
    progress(0.3, "reading the expression");
    const auto bytes = read_file(request.expression_source);
    if (!bytes) return bytes.error();
    auto shape = shape_of_file(*model, *bytes, wish.expression_file);
    if (!shape) return shape.error().where == "/expression" ? shape.error() : about_the_file(shape.error());
    expression = std::move(*shape);
  }
  progress(0.5, "surface");
  const glm::mat3 file_before(model->to_file_frame);
  WorkerResult result;
  const auto head = mark(*model, request, result);
  if (!head) return head.error();
  progress(0.8, "displacements");
  auto neutral = shape_of_field(*model, "/from", wish.from);
  if (!neutral) return neutral.error();
  if (request.expression_source.empty()) {
    auto shape = shape_of_field(*model, "/target", wish.target);
    if (!shape) return shape.error();
    expression = std::move(*shape);
  } else {
    // Turned as the head was.
    const glm::dmat3 turn = glm::inverse(glm::dmat3(glm::mat3(model->to_file_frame))) * glm::dmat3(file_before);
    for (glm::vec3& p : expression) p = glm::vec3(turn * glm::dvec3(p));
  }
  const ExtractOptions options{wish.align, wish.least, wish.strength};
  const auto extraction =
      extract_displacements(head->points, compute_fapu(head->points), *neutral, expression, options);
  if (!extraction) {
    // The set is what the request asks for: a set of nothing is a fault of what it names.
    Error error = extraction.error();
    if (error.code == ErrorCode::empty || error.code == ErrorCode::out_of_range) error.code = ErrorCode::mismatch;
    return error;
  }
  result.displacements = displacements_to_json(extraction->displacements).dump();
  result.taken = describe(*extraction).dump();
  return result;
}

}  // namespace semblante::jobs

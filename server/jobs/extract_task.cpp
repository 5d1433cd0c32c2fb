#include <glm/mat3x3.hpp>
#include <nlohmann/json.hpp>

#include "core/extract/extract.h"
#include "core/extract/set_file.h"
#include "core/extract/shape.h"
#include "core/parametrize/fapu.h"
#include "server/jobs/request_head.h"
#include "server/jobs/result_facts.h"
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
  auto imported = import_source(request, part_of(progress, 0.05, 0.3));
  if (!imported) return imported.error();
  std::vector<glm::vec3> expression;
  if (!request.expression_source.empty()) {
    if (auto told = report_progress(progress, 0.3, "reading the expression"); !told) return told.error();
    const auto bytes = read_file(request.expression_source);
    if (!bytes) return bytes.error();
    auto shape = shape_of_file(imported->model, *bytes, wish.expression_file);
    if (!shape) return shape.error().where == "/expression" ? shape.error() : about_the_file(shape.error());
    expression = std::move(*shape);
  }
  const auto head = mark_source(std::move(*imported), request, part_of(progress, 0.5, 0.8));
  if (!head) return head.error();
  if (auto told = report_progress(progress, 0.8, "displacements"); !told) return told.error();
  auto neutral = shape_of_field(head->model, "/from", wish.from);
  if (!neutral) return neutral.error();
  if (request.expression_source.empty()) {
    auto shape = shape_of_field(head->model, "/target", wish.target);
    if (!shape) return shape.error();
    expression = std::move(*shape);
  } else {
    // Turned as the head was.
    for (glm::vec3& p : expression) p = glm::vec3(head->to_mpeg4 * glm::dvec3(p));
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
  WorkerResult result;
  result.frame = head->frame;
  if (head->turn) result.turn = rows_of(*head->turn);
  result.displacements = displacements_to_json(extraction->displacements).dump();
  result.taken = describe(*extraction).dump();
  return result;
}

}  // namespace semblante::jobs

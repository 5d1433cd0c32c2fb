#include "server/jobs/extract_job.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <glm/mat3x3.hpp>
#include <nlohmann/json.hpp>

#include "core/extract/set_file.h"
#include "core/extract/shape.h"
#include "core/parametrize/fapu.h"
#include "server/jobs/request_head.h"
#include "server/jobs/result_files.h"
#include "server/store/record_json.h"

namespace semblante::jobs {
namespace {

using Json = nlohmann::ordered_json;

std::string dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json names(const std::vector<FeaturePointId>& points) {
  Json list = Json::array();
  for (const FeaturePointId point : points) list.push_back(to_string(point));
  return list;
}

/// The points of the set, and those skipped with the reason.
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

FeaturePointId read_point(const std::string& text) {
  const auto id = parse_feature_point(text);
  if (!id) throw std::invalid_argument("\"" + text + "\" is no feature point");
  return *id;
}

std::vector<FeaturePointId> read_points(const nlohmann::json& json) {
  std::vector<FeaturePointId> points;
  for (const auto& item : json) points.push_back(read_point(item.get<std::string>()));
  return points;
}

std::vector<MissingUnit> read_skipped(const nlohmann::json& json) {
  std::vector<MissingUnit> skipped;
  for (const auto& [point, unit] : json.items()) {
    const auto* const found = std::find(fapu_unit_names.begin(), fapu_unit_names.end(), unit.get<std::string>());
    if (found == fapu_unit_names.end()) throw std::invalid_argument("/skipped/" + point + ": there is no such unit");
    skipped.push_back({read_point(point), static_cast<FapuUnit>(found - fapu_unit_names.begin())});
  }
  // JSON sorts names as text, so 10.1 would precede 2.1.
  std::sort(skipped.begin(), skipped.end(), [](const auto& a, const auto& b) { return a.point < b.point; });
  return skipped;
}

/// The source of the set, as stored with it.
Json source_of_set(const store::JobRecord& job, const ExtractJob& wish) {
  const auto or_null = [](const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); };
  return {{"model", or_null(job.model)},
          {"neutral_file", or_null(wish.neutral_file)},
          {"expression_file", or_null(wish.expression_file)},
          {"target", or_null(wish.target)},
          {"from", or_null(wish.from)},
          {"align", wish.align},
          {"least", wish.least},
          {"strength", wish.strength}};
}

/// The shape of a morph target; an unknown name is an error of a field of the request.
Result<std::vector<glm::vec3>> shape_of_field(const Model& model, const std::string& field, const std::string& target) {
  auto shape = shape_of_target(model, target);
  if (!shape) return Error{ErrorCode::invalid_argument, field, shape.error().message};
  return shape;
}

}  // namespace

std::vector<std::string> ExtractJob::files() const {
  std::vector<std::string> hashes;
  for (const auto& hash : {expression_sha256, neutral_sha256})
    if (!hash.empty()) hashes.push_back(hash);
  return hashes;
}

Result<ExtractJob::Request> ExtractJob::request(const store::JobRecord& job, const JobSources& sources) const {
  Request request{{}, *this, {}};
  if (!expression_sha256.empty()) request.expression_path = path_of(sources.blobs, expression_sha256, "the expression");
  if (job.model.empty()) {
    request.head.model.path = path_of(sources.blobs, neutral_sha256, "the neutral head");
    request.head.model.file_name = neutral_file;
    request.head.points = points;
    return request;
  }
  const auto model = model_of(job, sources);
  if (!model) return model.error();
  request.head = marked_source_of(*model, sources);
  return request;
}

std::vector<std::string> ExtractJob::Request::inputs() const {
  std::vector<std::string> paths = {head.model.path};
  if (!expression_path.empty()) paths.push_back(expression_path);
  return paths;
}

Result<ExtractJob::Outcome> ExtractJob::run(const Request& request, const InputFiles& inputs, ResultFiles& /*files*/,
                                            const Progress& progress) {
  const ExtractJob& wish = request.wish;
  auto imported = import_source(request.head.model, inputs, part_of(progress, 0.05, 0.3));
  if (!imported) return imported.error();
  std::vector<glm::vec3> expression;
  if (!request.expression_path.empty()) {
    if (auto told = report_progress(progress, 0.3, "reading the expression"); !told) return told.error();
    const auto bytes = inputs.read(request.expression_path);
    if (!bytes) return bytes.error();
    auto shape = shape_of_file(imported->model, *bytes, wish.expression_file);
    if (!shape) return shape.error().where == "/expression" ? shape.error() : about_the_file(shape.error());
    expression = std::move(*shape);
  }
  const auto head = mark_source(std::move(*imported), request.head, part_of(progress, 0.5, 0.8));
  if (!head) return head.error();
  if (auto told = report_progress(progress, 0.8, "displacements"); !told) return told.error();
  auto neutral = shape_of_field(head->model, "/from", wish.from);
  if (!neutral) return neutral.error();
  if (request.expression_path.empty()) {
    auto shape = shape_of_field(head->model, "/target", wish.target);
    if (!shape) return shape.error();
    expression = std::move(*shape);
  } else {
    // Turned like the head, with its points' vertices.
    for (glm::vec3& p : expression) p = glm::vec3(head->to_mpeg4 * glm::dvec3(p));
    add_inserted(expression, head->inserted);
  }
  const ExtractOptions options{wish.align, wish.least, wish.strength};
  auto extraction = extract_displacements(head->points, compute_fapu(head->points, head->fapu_by_user), *neutral,
                                          expression, options);
  if (!extraction) {
    // An empty set is an error of the field that names the expression.
    Error error = extraction.error();
    if (error.code == ErrorCode::empty || error.code == ErrorCode::out_of_range) error.code = ErrorCode::mismatch;
    return error;
  }
  return Outcome{std::move(*extraction)};
}

std::vector<std::string> ExtractJob::finish(store::JobRecord& job, const Outcome& outcome,
                                            const std::vector<store::ArtefactRecord>& /*artefacts*/,
                                            store::JobStore& store) const {
  const Json taken = describe(outcome.extraction);
  Json source = source_of_set(job, *this);
  source.update(taken);
  store::SetRecord set;
  set.id = store::random_id();
  set.name = name;
  set.kind = kind;
  set.created = set.updated = store::timestamp_now();
  set.displacements = displacements_to_json(outcome.extraction.displacements).dump();
  set.source = dump(source);
  set.owner = job.origin.owner;
  Json result = {{"expression", set.id}, {"href", "/v1/expressions/" + set.id}};
  result.update(taken);
  job.result = dump(result);
  return store.finish_extraction(job, set);
}

void to_json(nlohmann::json& json, const ExtractJob& job) {
  json = {{"name", job.name},
          {"kind", job.kind},
          {"align", job.align},
          {"least", job.least},
          {"strength", job.strength},
          {"target", job.target},
          {"from", job.from},
          {"expression_file", job.expression_file},
          {"expression_sha256", job.expression_sha256},
          {"neutral_file", job.neutral_file},
          {"neutral_sha256", job.neutral_sha256},
          {"points", job.points}};
}

void from_json(const nlohmann::json& json, ExtractJob& job) {
  json.at("name").get_to(job.name);
  json.at("kind").get_to(job.kind);
  json.at("align").get_to(job.align);
  json.at("least").get_to(job.least);
  json.at("strength").get_to(job.strength);
  json.at("target").get_to(job.target);
  json.at("from").get_to(job.from);
  json.at("expression_file").get_to(job.expression_file);
  json.at("expression_sha256").get_to(job.expression_sha256);
  json.at("neutral_file").get_to(job.neutral_file);
  json.at("neutral_sha256").get_to(job.neutral_sha256);
  json.at("points").get_to(job.points);
}

void to_json(nlohmann::json& json, const ExtractJob::Request& request) {
  json = {{"head", request.head}, {"wish", request.wish}, {"expression_path", request.expression_path}};
}

void from_json(const nlohmann::json& json, ExtractJob::Request& request) {
  json.at("head").get_to(request.head);
  json.at("wish").get_to(request.wish);
  json.at("expression_path").get_to(request.expression_path);
}

void to_json(nlohmann::json& json, const ExtractJob::Outcome& outcome) {
  json = describe(outcome.extraction);
  json.erase("points");  // the set has their number
  json["displacements"] = displacements_to_json(outcome.extraction.displacements);
}

void from_json(const nlohmann::json& json, ExtractJob::Outcome& outcome) {
  auto displacements = displacements_from_json(json.at("displacements"));
  if (!displacements) throw std::invalid_argument("/displacements: " + displacements.error().message);
  Extraction& extraction = outcome.extraction;
  extraction.displacements = std::move(*displacements);
  extraction.skipped = read_skipped(json.at("skipped"));
  extraction.at_rest = read_points(json.at("at_rest"));
  extraction.bare = read_points(json.at("at_no_vertex"));
  extraction.unmarked = read_points(json.at("not_marked"));
  if (const auto& motion = json.at("head_motion"); !motion.is_null())
    extraction.removed = RemovedMotion{motion.at("degrees"), motion.at("distance")};
}

}  // namespace semblante::jobs

#include "server/jobs/marked_model.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "core/import/import.h"
#include "core/parametrize/place_feature_points.h"
#include "server/jobs/standing.h"

namespace semblante::jobs {
namespace {

std::vector<std::optional<PartRole>> roles_by_user(const WorkerRequest& request) {
  std::vector<std::optional<PartRole>> roles;
  for (const auto& part : request.parts) {
    const auto* found = std::find(part_role_names.begin(), part_role_names.end(), part.role);
    roles.push_back(part.role_by_user && found != part_role_names.end()
                        ? std::optional(static_cast<PartRole>(found - part_role_names.begin()))
                        : std::nullopt);
  }
  return roles;
}

Result<std::vector<MarkedPoint>> marked_points(const WorkerRequest& request) {
  std::vector<MarkedPoint> points;
  for (const auto& record : request.points) {
    const auto id = parse_feature_point(record.id);
    if (!id) return Error{ErrorCode::invalid_argument, "/points/" + record.id, "it is none of the 84 feature points"};
    MarkedPoint point{*id, record.vertex, std::nullopt};
    if (record.position)
      point.position = glm::dvec3((*record.position)[0], (*record.position)[1], (*record.position)[2]);
    points.push_back(point);
  }
  return points;
}

}  // namespace

Result<std::vector<std::uint8_t>> read_file(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return Error{ErrorCode::io, "", "the bytes of the model cannot be read"};
  return std::vector<std::uint8_t>((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
}

Error about_the_file(Error error) {
  if (error.code == ErrorCode::missing || error.code == ErrorCode::mismatch ||
      error.code == ErrorCode::invalid_argument)
    error.code = ErrorCode::malformed;
  return error;
}

Result<Model> read_model(const WorkerRequest& request) {
  auto bytes = read_file(request.source);
  if (!bytes) return bytes.error();
  const auto format = detect_format(*bytes, request.file_name);
  if (!format) return Error{ErrorCode::unsupported, "", "the file is none of GLB, glTF (zipped), OBJ, PLY, STL"};
  auto model = import_model(*bytes, *format);
  if (!model) return about_the_file(model.error());
  return model;
}

Result<MarkedModel> mark(Model& model, const WorkerRequest& request, WorkerResult& result) {
  stand_as_before(model, request);
  MarkedModel head;
  head.surface = build_surface(model);
  head.roles = roles_by_user(request);
  auto marked = marked_points(request);
  if (!marked) return marked.error();
  auto points = place_feature_points(model, head.surface, *marked, &head.warnings, head.roles);
  if (!points) return points.error();
  head.is_turned = stand_by_points(model, head.surface, *marked, *points, request, result);
  if (head.is_turned) {
    head.warnings.clear();
    points = place_feature_points(model, head.surface, *marked, &head.warnings, head.roles);
    if (!points) return points.error();
  }
  head.points = std::move(*points);
  return head;
}

}  // namespace semblante::jobs

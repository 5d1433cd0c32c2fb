#include "server/jobs/request_head.h"

#include <algorithm>
#include <utility>

#include "core/parametrize/fapu.h"

namespace semblante::jobs {
namespace {

std::vector<std::optional<PartRole>> roles_by_user(const std::vector<store::PartRecord>& parts) {
  std::vector<std::optional<PartRole>> roles;
  for (const auto& part : parts) {
    const auto* found = std::find(part_role_names.begin(), part_role_names.end(), part.role);
    if (!part.role_by_user || found == part_role_names.end()) continue;
    if (roles.size() <= part.index) roles.resize(part.index + std::size_t{1});
    roles[part.index] = static_cast<PartRole>(found - part_role_names.begin());
  }
  return roles;
}

Result<std::vector<MarkedPoint>> marked_points(const std::vector<store::FeaturePointRecord>& records) {
  std::vector<MarkedPoint> points;
  for (const auto& record : records) {
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

Error about_the_file(Error error) {
  if (error.code == ErrorCode::missing || error.code == ErrorCode::mismatch ||
      error.code == ErrorCode::invalid_argument)
    error.code = ErrorCode::malformed;
  return error;
}

Result<ImportedHead> import_source(const ModelSource& source, const InputFiles& inputs, const Progress& progress) {
  const auto bytes = inputs.read(source.path);
  if (!bytes) return bytes.error();
  auto head = import_head(*bytes, {source.file_name, std::nullopt, {}, {}}, progress);
  if (!head) return about_the_file(head.error());
  return head;
}

Result<MarkedHead> mark_source(ImportedHead head, const MarkedSource& source, const Progress& progress) {
  auto points = marked_points(source.points);
  if (!points) return points.error();
  auto fapu = fapu_from_lengths(source.fapu);
  if (!fapu) return Error{fapu.error().code, "/fapu", fapu.error().message};
  // The positions of the points are in the frame of the model's import; without a frame, in that of the file.
  auto standing =
      stand_head(std::move(head), {source.model.frame_wish, source.model.frame.value_or(ModelFrame{}), {}}, progress);
  if (!standing) return standing.error();
  return mark_head(std::move(*standing), {std::move(*points), roles_by_user(source.parts), false, *fapu},
                   part_of(progress, 0.5, 1.0));
}

}  // namespace semblante::jobs

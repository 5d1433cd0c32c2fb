#include "server/jobs/worker_tasks.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <span>

#include <nlohmann/json.hpp>

#include "core/doctor/examine.h"
#include "core/extract/set_file.h"
#include "core/geometry/surface.h"
#include "core/import/import.h"
#include "core/lod/decimate.h"
#include "core/lod/level_error.h"
#include "core/lod/lod_poses.h"
#include "core/parametrize/parametrize.h"
#include "core/parametrize/part_roles.h"
#include "core/parametrize/place_feature_points.h"
#include "core/propose/propose.h"
#include "protocol/cpp/rig_document.h"
#include "server/jobs/marked_model.h"
#include "server/jobs/standing.h"
#include "server/package/package.h"
#include "server/report/levels_json.h"
#include "server/report/report_json.h"
#include "server/store/frame_json.h"
#include "server/store/store_error.h"

namespace semblante::jobs {
namespace {

static_assert(std::endian::native == std::endian::little, "`positions` is written as it lies in memory");

/// Adds one file to the output directory and to the result.
Status write_artefact(const WorkerRequest& request, WorkerResult& result, const std::string& name,
                      const std::string& content_type, std::span<const std::uint8_t> bytes) {
  errno = 0;
  std::ofstream stream(request.output_directory + "/" + name, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!stream.flush()) {
    store::throw_if_disk_full(name, errno);
    return Error{ErrorCode::io, "", name + " cannot be written"};
  }
  result.artefacts.push_back({name, "", bytes.size(), content_type});
  return Unit{};
}

/// Adds report.json and its counts.
Status write_report_artefact(const WorkerRequest& request, WorkerResult& result, const Report& report,
                             std::span<const ReportSection> sections = {}) {
  const auto counts = report.counts();
  result.findings =
      store::FindingCounts{static_cast<std::uint32_t>(counts.errors), static_cast<std::uint32_t>(counts.warnings),
                           static_cast<std::uint32_t>(counts.notes)};
  const auto json = write_report(report, sections);
  return write_artefact(request, result, "report.json", "application/json",
                        {reinterpret_cast<const std::uint8_t*>(json.data()), json.size()});
}

Status write_positions(const WorkerRequest& request, WorkerResult& result, const Model& model) {
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
  return write_artefact(
      request, result, "positions", "application/octet-stream",
      {reinterpret_cast<const std::uint8_t*>(model.positions.data()), model.positions.size() * sizeof(glm::vec3)});
}

ReportSection frame_section(const WorkerRequest& request, const WorkerResult& result) {
  return {"frame", store::frame_to_json(*result.frame, request.frame_wish).dump()};
}

std::vector<store::PartRecord> records_of(std::span<const Part> parts) {
  std::vector<store::PartRecord> records;
  for (const auto& part : parts) {
    store::PartRecord record;
    record.name = part.name;
    record.role = std::string(part_role_names[static_cast<std::size_t>(part.role)]);
    record.role_by_user = part.role_by_user;
    record.vertices = part.vertex_count;
    record.triangles = part.triangle_count;
    record.box_min = {part.box_min.x, part.box_min.y, part.box_min.z};
    record.box_max = {part.box_max.x, part.box_max.y, part.box_max.z};
    records.push_back(std::move(record));
  }
  return records;
}

void describe(const Model& model, WorkerResult& result) {
  result.format = model.format;
  result.vertices = static_cast<std::uint32_t>(model.positions.size());
  result.triangles = static_cast<std::uint32_t>(model.triangles.size());
  if (model.positions.empty()) return;
  glm::vec3 low = model.positions.front();
  glm::vec3 high = low;
  for (const auto& position : model.positions) {
    low = glm::min(low, position);
    high = glm::max(high, position);
  }
  result.box_min = {low.x, low.y, low.z};
  result.box_max = {high.x, high.y, high.z};
}

/// The server's own sets come back to it as they were checked when they were made.
Result<std::vector<NamedSet>> read_worn(const WorkerRequest& request) {
  std::vector<NamedSet> sets;
  for (const auto& worn : request.worn) {
    auto set = parse_displacement_set("{\"displacements\":" + worn.displacements + "}");
    if (!set) return Error{ErrorCode::internal, set.error().where, set.error().message};
    set->name = worn.slot;
    sets.push_back(std::move(*set));
  }
  return sets;
}

/// Levels of detail, and what the report says of them.
struct Levels {
  std::vector<LevelOfDetail> levels;
  std::string report;
};

Result<Levels> make_levels(const WorkerRequest& request, const Model& model, const Surface& surface, Rig& rig,
                           const Progress& progress) {
  Levels made;
  LodOptions options;
  options.budgets = request.lods;
  const auto poses = options.budgets.empty() ? std::vector<LodPose>() : lod_poses(rig, model);
  const auto labels = options.budgets.empty() ? std::vector<std::uint8_t>() : material_labels(model, surface, rig);
  options.poses = poses;
  options.labels = labels;
  options.progress = [&](double share) { return progress(0.74 + 0.08 * share, "levels of detail"); };
  auto levels = decimate(model, surface, rig, options);
  if (!levels) return levels.error();
  made.levels = std::move(*levels);
  std::vector<LevelError> errors;
  for (const LevelOfDetail& level : made.levels) {
    progress(0.82 + 0.04 * static_cast<double>(errors.size()) / static_cast<double>(made.levels.size()),
             "measuring levels");
    errors.push_back(measure_level(model, surface, level, poses));
  }
  const auto missed = missed_budgets(options.budgets, made.levels);
  for (const MissedBudget& miss : missed) rig.warnings.push_back(miss.words);
  const double eye_separation = 1024.0 * rig.fapu[FapuUnit::es].value_or(0.0);
  made.report = write_levels_of_detail(made.levels, errors, poses, eye_separation, missed);
  return made;
}

/// The files of the next level.
Status write_package(const WorkerRequest& request, WorkerResult& result, const FacePackage& package) {
  const std::size_t lod = result.levels.size();
  result.levels.push_back({package.vertices, package.triangles});
  struct File {
    std::string_view name, content_type;
    const Artefact& artefact;
  };
  const File files[] = {{"mesh.drc", "application/octet-stream", package.mesh_drc},
                        {"weights", "application/vnd.semblante.weights", package.weights},
                        {"rig.json", "application/json", package.rig_json},
                        {"face.glb", "model/gltf-binary", package.face_glb}};
  for (const auto& file : files)
    if (auto written = write_artefact(request, result, store::artefact_name(lod, file.name),
                                      std::string(file.content_type), file.artefact.bytes);
        !written)
      return written;
  return Unit{};
}

}  // namespace

Result<WorkerResult> run_import(const WorkerRequest& request, const Progress& progress) {
  progress(0.05, "reading");
  auto model = read_model(request);
  if (!model) return model.error();
  progress(0.5, "surface");
  WorkerResult result;
  auto surface = build_surface(*model);
  stand_upright(*model, surface, request, result);
  const auto parts = describe_parts(*model, surface, {}, {});
  describe(*model, result);
  result.parts = records_of(parts);
  result.warnings = model->warnings;

  progress(0.6, "report");
  const ReportSection frame = frame_section(request, result);
  if (auto written = write_report_artefact(request, result, examine_mesh(*model, surface, parts), {&frame, 1});
      !written)
    return written.error();

  progress(0.7, "preview");
  const auto preview = build_preview(*model, surface, parts);
  if (!preview) return preview.error();
  if (auto written = write_artefact(request, result, "preview.glb", "model/gltf-binary", *preview); !written)
    return written.error();
  if (auto written = write_positions(request, result, *model); !written) return written.error();
  constexpr std::size_t most_listed = 512;
  for (const Example& example : model->examples) {
    if (result.morph_targets.size() == most_listed) break;
    result.morph_targets.push_back({example.name, static_cast<std::uint32_t>(example.vertices.size())});
  }
  return result;
}

Result<WorkerResult> run_parametrize(const WorkerRequest& request, const Progress& progress) {
  progress(0.02, "reading");
  auto model = read_model(request);
  if (!model) return model.error();
  progress(0.06, "surface");
  WorkerResult result;
  auto head = mark(*model, request, result);
  if (!head) return head.error();
  auto& [surface, roles, points, warnings, is_turned] = *head;
  warnings.insert(warnings.begin(), model->warnings.begin(), model->warnings.end());

  ParametrizeOptions options;
  options.roles_by_user = roles;
  const auto weights = parse_weight_method(request.weights);
  if (!weights)
    return Error{ErrorCode::invalid_argument, "/weights", "there are no weights \"" + request.weights + "\""};
  options.weights = *weights;
  const auto metric = parse_distance_metric(request.metric);
  if (!metric) return Error{ErrorCode::invalid_argument, "/metric", "there is no metric \"" + request.metric + "\""};
  options.metric = *metric;
  options.progress = [&](double share, std::string_view stage) { return progress(0.08 + 0.64 * share, stage); };
  auto rig = parametrize(*model, surface, points, options);
  if (!rig) return rig.error();
  rig->warnings.insert(rig->warnings.begin(), warnings.begin(), warnings.end());

  progress(0.72, "report");
  const auto report = examine(*model, surface, *rig, options.weights);
  auto levels = make_levels(request, *model, surface, *rig, progress);
  if (!levels) return levels.error();
  progress(0.86, "package");
  auto worn = read_worn(request);
  if (!worn) return worn.error();
  const auto packages =
      build_packages(*model, surface, *rig, levels->levels, {request.name, request.weight_bits, std::move(*worn)});
  if (!packages) return packages.error();
  const FacePackage* const package = &packages->front();
  progress(0.96, "writing");
  describe(*model, result);
  result.parts = records_of(rig->parts);
  const auto rig_json =
      read_rig({reinterpret_cast<const char*>(package->rig_json.bytes.data()), package->rig_json.bytes.size()});
  if (!rig_json) return Error{ErrorCode::internal, rig_json.error().where, rig_json.error().message};
  result.warnings = rig_json->warnings;
  for (const FacePackage& level : *packages) {
    if (auto written = write_package(request, result, level); !written) return written.error();
  }
  const ReportSection sections[] = {frame_section(request, result), {"levels_of_detail", std::move(levels->report)}};
  if (auto written = write_report_artefact(request, result, report, sections); !written) return written.error();
  if (is_turned) {
    const auto preview = build_preview(*model, surface, rig->parts);
    if (!preview) return preview.error();
    if (auto written = write_artefact(request, result, "preview.glb", "model/gltf-binary", *preview); !written)
      return written.error();
    if (auto written = write_positions(request, result, *model); !written) return written.error();
  }
  for (std::size_t i = 0; i < package->images.size(); ++i) {
    const auto& image = package->images[i];
    const auto info = std::find_if(rig_json->images.begin(), rig_json->images.end(),
                                   [&](const auto& item) { return item.sha256 == image.sha256; });
    const auto type = info == rig_json->images.end() ? std::string("application/octet-stream") : info->mime_type;
    if (auto written = write_artefact(request, result, "image-" + std::to_string(i), type, image.bytes); !written)
      return written.error();
  }
  return result;
}

Result<WorkerResult> run_propose(const WorkerRequest& request, const Progress& progress) {
  progress(0.05, "reading");
  auto model = read_model(request);
  if (!model) return model.error();
  progress(0.5, "surface");
  WorkerResult result;
  // Relations hold for an upright head; what is proposed is told of the model as it stands so far.
  const auto head = mark(*model, request, result);
  if (!head) return head.error();
  progress(0.8, "proposals");
  const auto parts = describe_parts(*model, head->surface, head->points, head->roles);
  const auto proposals = propose_feature_points(head->surface, parts, head->points);
  if (!proposals) return proposals.error();
  describe(*model, result);
  for (const auto& proposal : proposals->points) {
    store::FeaturePointRecord record;
    record.id = to_string(proposal.point.id);
    const glm::dvec3 position = turned_back(proposal.point.position, result.turn);
    if (proposal.point.vertex)
      record.vertex = proposal.point.vertex->value();
    else
      record.position = {position.x, position.y, position.z};
    record.proposal =
        store::ProposalRecord{std::string(proposal_method_names[static_cast<std::size_t>(proposal.method)]),
                              std::string(confidence_names[static_cast<std::size_t>(proposal.confidence)]),
                              proposal.expected_error, proposal.remark};
    result.proposals.push_back(std::move(record));
  }
  for (const auto& point : proposals->not_proposed) result.not_proposed.emplace_back(to_string(point.id), point.reason);
  result.frame.reset();
  result.turn.reset();
  return result;
}

}  // namespace semblante::jobs

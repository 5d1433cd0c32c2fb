#include <utility>

#include <nlohmann/json.hpp>

#include "core/doctor/examine.h"
#include "core/extract/set_file.h"
#include "core/pipeline/levelled.h"
#include "protocol/package/pack_head.h"
#include "server/jobs/request_head.h"
#include "server/jobs/result_facts.h"
#include "server/jobs/result_files.h"
#include "server/jobs/worker_tasks.h"
#include "server/report/levels_json.h"

namespace semblante::jobs {
namespace {

Result<RigRequest> rig_request(const WorkerRequest& request) {
  const auto weights = parse_weight_method(request.weights);
  if (!weights)
    return Error{ErrorCode::invalid_argument, "/weights", "there are no weights \"" + request.weights + "\""};
  const auto metric = parse_distance_metric(request.metric);
  if (!metric) return Error{ErrorCode::invalid_argument, "/metric", "there is no metric \"" + request.metric + "\""};
  return RigRequest{*weights, *metric};
}

/// The sets were checked when the store got them: one that cannot be read is a fault of ours.
Result<std::vector<NamedSet>> worn_sets(const WorkerRequest& request) {
  std::vector<NamedSet> sets;
  for (const auto& worn : request.worn) {
    auto displacements = parse_set_displacements(worn.displacements);
    if (!displacements) return Error{ErrorCode::internal, displacements.error().where, displacements.error().message};
    NamedSet set;
    set.name = worn.slot;
    set.displacements = std::move(*displacements);
    sets.push_back(std::move(set));
  }
  return sets;
}

Result<LevelledHead> make_head(const WorkerRequest& request, const RigRequest& rig, const Progress& progress,
                               Report& report) {
  auto imported = import_source(request, part_of(progress, 0.02, 0.06));
  if (!imported) return imported.error();
  auto marked = mark_source(std::move(*imported), request, part_of(progress, 0.06, 0.08));
  if (!marked) return marked.error();
  auto rigged = rig_head(std::move(*marked), rig, part_of(progress, 0.08, 0.72));
  if (!rigged) return rigged.error();
  if (auto told = report_progress(progress, 0.72, "report"); !told) return told.error();
  report = examine(rigged->model, rigged->surface, rigged->rig, rig.weights);
  return level_head(std::move(*rigged), request.lods, part_of(progress, 0.74, 0.82));
}

}  // namespace

Result<WorkerResult> run_parametrize(const WorkerRequest& request, const Progress& progress) {
  const auto rig = rig_request(request);
  if (!rig) return rig.error();
  auto worn = worn_sets(request);
  if (!worn) return worn.error();
  Report report;
  const auto head = make_head(request, *rig, progress, report);
  if (!head) return head.error();
  const auto errors = measure_levels(*head, part_of(progress, 0.82, 0.86));
  if (!errors) return errors.error();
  const auto packages =
      pack_head(*head, {request.name, request.weight_bits, std::move(*worn)}, part_of(progress, 0.86, 0.96));
  if (!packages) return packages.error();

  if (auto told = report_progress(progress, 0.96, "writing"); !told) return told.error();
  WorkerResult result;
  describe(head->model, result);
  result.parts = records_of(head->rig.parts);
  result.warnings = head->warnings.all();
  result.frame = head->frame;
  ResultFiles files(request, result);
  if (auto written = files.write_packages(*packages); !written) return written.error();
  const double eye_separation = 1024.0 * head->rig.fapu[FapuUnit::es].value_or(0.0);
  auto levels = levels_of_detail_json(head->levels, *errors, head->poses, eye_separation, head->missed);
  if (auto written = files.write_report(report, head->frame, {{"levels_of_detail", std::move(levels)}}); !written)
    return written.error();
  if (head->turn) {
    result.turn = rows_of(*head->turn);
    if (auto written = files.write_preview(*head, head->rig.parts); !written) return written.error();
  }
  return result;
}

}  // namespace semblante::jobs

#include <utility>

#include "core/anatomy/part_roles.h"
#include "core/doctor/examine.h"
#include "server/jobs/request_head.h"
#include "server/jobs/result_facts.h"
#include "server/jobs/result_files.h"
#include "server/jobs/worker_tasks.h"

namespace semblante::jobs {

Result<WorkerResult> run_import(const WorkerRequest& request, const Progress& progress) {
  auto imported = import_source(request, part_of(progress, 0.05, 0.5));
  if (!imported) return imported.error();
  const auto head = stand_head(std::move(*imported), {request.frame_wish, {}, {}}, part_of(progress, 0.5, 0.6));
  if (!head) return head.error();

  WorkerResult result;
  describe(head->model, result);
  result.warnings = head->warnings.all();
  result.frame = head->frame;
  // The store turns what was marked on the head as it stood before.
  if (request.frame && request.frame->axes != head->frame.axes)
    result.turn = rows_of(turn_between(request.frame->axes, head->frame.axes));
  const auto parts = describe_parts(head->model, head->surface, {}, {});
  result.parts = records_of(parts);
  constexpr std::size_t most_listed = 512;
  for (const Example& example : head->model.examples) {
    if (result.morph_targets.size() == most_listed) break;
    result.morph_targets.push_back({example.name, static_cast<std::uint32_t>(example.vertices.size())});
  }

  ResultFiles files(request, result);
  if (auto told = report_progress(progress, 0.6, "report"); !told) return told.error();
  if (auto written = files.write_report(examine_mesh(head->model, head->surface, parts), head->frame); !written)
    return written.error();
  if (auto told = report_progress(progress, 0.7, "preview"); !told) return told.error();
  if (auto written = files.write_preview(*head, parts); !written) return written.error();
  return result;
}

}  // namespace semblante::jobs

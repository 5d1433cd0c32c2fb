#include <utility>

#include <glm/matrix.hpp>

#include "core/anatomy/part_roles.h"
#include "core/propose/propose.h"
#include "server/jobs/request_head.h"
#include "server/jobs/result_facts.h"
#include "server/jobs/worker_tasks.h"

namespace semblante::jobs {
namespace {

/// A proposal does not turn the stored model: its positions are told of the model as it was in the request.
store::FeaturePointRecord record_of(const Proposal& proposal, const glm::dmat3& back) {
  store::FeaturePointRecord record;
  record.id = to_string(proposal.point.id);
  const glm::dvec3 position = back * glm::dvec3(proposal.point.position);
  if (proposal.point.vertex)
    record.vertex = proposal.point.vertex->value();
  else
    record.position = {position.x, position.y, position.z};
  record.proposal = store::ProposalRecord{std::string(proposal_method_names[static_cast<std::size_t>(proposal.method)]),
                                          std::string(confidence_names[static_cast<std::size_t>(proposal.confidence)]),
                                          proposal.expected_error, proposal.remark};
  return record;
}

}  // namespace

Result<WorkerResult> run_propose(const WorkerRequest& request, const Progress& progress) {
  auto imported = import_source(request, part_of(progress, 0.05, 0.5));
  if (!imported) return imported.error();
  // The relations between points hold for an upright head.
  const auto head = mark_source(std::move(*imported), request, part_of(progress, 0.5, 0.8));
  if (!head) return head.error();
  if (auto told = report_progress(progress, 0.8, "proposals"); !told) return told.error();
  const auto parts = describe_parts(head->model, head->surface, head->points, head->roles_by_user);
  const auto proposals = propose_feature_points(head->surface, parts, head->points);
  if (!proposals) return proposals.error();

  WorkerResult result;
  describe(head->model, result);
  const glm::dmat3 back = head->turn ? glm::transpose(*head->turn) : glm::dmat3(1.0);
  for (const auto& proposal : proposals->points) result.proposals.push_back(record_of(proposal, back));
  for (const auto& point : proposals->not_proposed) result.not_proposed.emplace_back(to_string(point.id), point.reason);
  return result;
}

}  // namespace semblante::jobs

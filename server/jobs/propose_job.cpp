#include "server/jobs/propose_job.h"

#include <utility>

#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "core/pipeline/proposed.h"
#include "server/jobs/request_head.h"
#include "server/jobs/result_facts.h"
#include "server/jobs/result_files.h"
#include "server/store/record_json.h"

namespace semblante::jobs {
namespace {

/// A proposal does not turn the stored model: its positions are in the model's frame of the request.
store::FeaturePointRecord record_of(const Proposal& proposal, const MarkedHead& head, const glm::dmat3& back) {
  store::FeaturePointRecord record;
  record.id = to_string(proposal.point.id);
  const glm::dvec3 position = back * glm::dvec3(proposal.point.position);
  if (proposal.point.vertex && head.is_of_file(*proposal.point.vertex))
    record.vertex = proposal.point.vertex->value();
  else
    record.position = {position.x, position.y, position.z};
  record.proposal = store::ProposalRecord{std::string(proposal_method_names[static_cast<std::size_t>(proposal.method)]),
                                          std::string(confidence_names[static_cast<std::size_t>(proposal.confidence)]),
                                          proposal.expected_error, proposal.remark};
  return record;
}

}  // namespace

Result<ProposeJob::Request> ProposeJob::request(const store::JobRecord& job, const JobSources& sources) const {
  const auto model = model_of(job, sources);
  if (!model) return model.error();
  auto head = marked_source_of(*model, sources);
  std::erase_if(head.points, [](const auto& point) { return point.proposal.has_value(); });
  return Request{std::move(head)};
}

Result<ProposeJob::Outcome> ProposeJob::run(const Request& request, const InputFiles& inputs, ResultFiles& /*files*/,
                                            const Progress& progress) {
  auto imported = import_source(request.head.model, inputs, part_of(progress, 0.05, 0.5));
  if (!imported) return imported.error();
  // The relations between points are defined for an upright head.
  const auto head = mark_source(std::move(*imported), request.head, part_of(progress, 0.5, 0.8));
  if (!head) return head.error();
  if (auto told = report_progress(progress, 0.8, "proposals"); !told) return told.error();
  const auto proposals = propose_points(*head);
  if (!proposals) return proposals.error();

  Outcome outcome;
  const glm::dmat3 back = head->turn ? glm::transpose(*head->turn) : glm::dmat3(1.0);
  for (const auto& proposal : proposals->points) outcome.proposals.push_back(record_of(proposal, *head, back));
  for (const auto& point : proposals->not_proposed)
    outcome.not_proposed.emplace_back(to_string(point.id), point.reason);
  return outcome;
}

/// The points of the model are merged, not replaced: see JobStore::finish_proposal.
std::vector<std::string> ProposeJob::finish(store::JobRecord& job, const Outcome& outcome,
                                            const std::vector<store::ArtefactRecord>& /*artefacts*/,
                                            store::JobStore& store) const {
  nlohmann::json result = {{"proposed", outcome.proposals.size()}, {"not_proposed", nlohmann::json::object()}};
  for (const auto& [id, reason] : outcome.not_proposed) result["not_proposed"][id] = reason;
  job.result = result.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  store.finish_proposal(job, outcome.proposals);
  return {};
}

void to_json(nlohmann::json& json, const ProposeJob& /*job*/) { json = nlohmann::json::object(); }
void from_json(const nlohmann::json& /*json*/, ProposeJob& /*job*/) {}

void to_json(nlohmann::json& json, const ProposeJob::Request& request) { json = {{"head", request.head}}; }

void from_json(const nlohmann::json& json, ProposeJob::Request& request) { json.at("head").get_to(request.head); }

void to_json(nlohmann::json& json, const ProposeJob::Outcome& outcome) {
  json = {{"proposals", outcome.proposals}, {"not_proposed", outcome.not_proposed}};
}

void from_json(const nlohmann::json& json, ProposeJob::Outcome& outcome) {
  json.at("proposals").get_to(outcome.proposals);
  json.at("not_proposed").get_to(outcome.not_proposed);
}

}  // namespace semblante::jobs

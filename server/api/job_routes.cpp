#include <nlohmann/json.hpp>

#include "core/lod/decimate.h"
#include "core/parametrize/weight_method.h"
#include "protocol/hash/sha256.h"
#include "server/api/common.h"
#include "server/api/generated/body_members.h"
#include "server/api/generated/handlers.h"
#include "server/api/job_events.h"
#include "server/api/new_parametrization.h"
#include "server/api/quota.h"
#include "server/api/storage_problems.h"

namespace semblante::api {
namespace {

/// Vertex budgets of the levels of detail: a list, or "auto" for a choice by the model's number of vertices.
std::vector<std::uint32_t> read_budgets(const JsonBody& lods, std::uint32_t vertices) {
  if (lods == "auto") return default_budgets(vertices);
  if (!lods.is_array() || lods.size() > max_levels)
    refuse("invalid-field",
           "it must be \"auto\" or a list of at most " + std::to_string(max_levels) + " numbers of vertices", "/lods");
  std::vector<std::uint32_t> budgets;
  for (const auto& item : lods) {
    const auto pointer = "/lods/" + std::to_string(budgets.size());
    if (!item.is_number_integer() || item < least_budget || item > most_budget)
      refuse("invalid-field",
             "it must be a whole number from " + std::to_string(least_budget) + " to " + std::to_string(most_budget),
             pointer);
    const auto budget = item.get<std::uint32_t>();
    if (!budgets.empty() && budget >= budgets.back())
      refuse("invalid-field", "it must be less than the number before it", pointer);
    budgets.push_back(budget);
  }
  return budgets;
}

/// Whether the shapes fit is found by the worker; that there are none is known before.
void refuse_without_shapes(const jobs::ParametrizeJob& options, const store::ModelRecord& model) {
  if (!model.morph_targets.empty()) return;
  const char* const asking = options.weights == "fitted"    ? "/weights"
                             : options.expressions == "own" ? "/expressions"
                                                            : nullptr;
  if (asking != nullptr)
    refuse("invalid-field", "it needs shapes of the head's own (morph targets), and the model has none", asking);
}

jobs::ParametrizeJob read_options(const JsonBody& body, std::uint32_t vertices) {
  refuse_unknown_members(body, body_members::create_parametrization);
  jobs::ParametrizeJob options;
  if (body.contains("metric")) {
    if (!body["metric"].is_string() || !parse_distance_metric(body["metric"].get<std::string>()))
      refuse("invalid-field", "it must be \"edge\" or \"unfolded\"", "/metric");
    options.metric = body["metric"].get<std::string>();
  }
  if (body.contains("weights")) {
    if (!body["weights"].is_string() || !parse_weight_method(body["weights"].get<std::string>()))
      refuse("invalid-field", "it must be \"paper\", \"smooth\" or \"fitted\"", "/weights");
    options.weights = body["weights"].get<std::string>();
  }
  if (body.contains("expressions")) {
    if (body["expressions"] != "library" && body["expressions"] != "own")
      refuse("invalid-field", "it must be \"library\" or \"own\"", "/expressions");
    options.expressions = body["expressions"].get<std::string>();
  }
  if (body.contains("weight_bits")) {
    const auto& bits = body["weight_bits"];
    if (!bits.is_number_integer() || bits < 8 || bits > 16)
      refuse("invalid-field", "it must be a whole number from 8 to 16", "/weight_bits");
    options.weight_bits = bits.get<int>();
  }
  if (body.contains("articulation")) {
    const auto& articulation = body["articulation"];
    if (!articulation.is_number() || !is_articulation(articulation.get<double>()))
      refuse("invalid-field", "it must be a number from 0.25 to 4", "/articulation");
    options.articulation = articulation.get<double>();
  }
  if (body.contains("lods")) options.lods = read_budgets(body["lods"], vertices);
  return options;
}

http::Response earlier_job(Context& context, const std::string& id) {
  if (const auto job = context.jobs.find(id)) return accepted(*job);
  refuse("conflict", "what this Idempotency-Key created has been removed");
}

store::JobRecord job_of(Context& context, const http::Request& request) {
  const auto& id = request.params.at("job");
  auto job = context.jobs.find(id);
  if (!job) refuse("not-found", "there is no job " + id);
  return std::move(*job);
}

}  // namespace

http::Response create_parametrization(Context& context, http::Request& request) {
  const auto model = model_of(context, request);
  const auto options = read_options(body_object(request), model.vertices);
  auto check = check_idempotency(context, request, sha256_hex(request.body));
  if (check.earlier) return earlier_job(context, *check.earlier);
  refuse_unless_imported(model);
  refuse_without_shapes(options, model);
  if (model.feature_point_count == 0)
    refuse("missing-feature-points", "no feature point is marked on this model", "/points");
  refuse_unless_room(context.jobs);
  const auto turn = take_quota(context, request, {.bytes = 1, .jobs = 1});
  const auto job = add_parametrization(context.store, model.id, options, check.record, origin_of(request));
  context.jobs.enqueue(job);
  return accepted(job);
}

http::Response create_proposals(Context& context, http::Request& request) {
  const auto model = model_of(context, request);
  refuse_unknown_members(body_object(request), body_members::create_proposals);
  auto check = check_idempotency(context, request, sha256_hex(request.body));
  if (check.earlier) return earlier_job(context, *check.earlier);
  check_if_match(request, points_etag(model));
  refuse_unless_imported(model);
  refuse_unless_room(context.jobs);
  const auto turn = take_quota(context, request, {.jobs = 1});
  const auto job = jobs::new_record(jobs::ProposeJob{}, model.id, origin_of(request));
  if (check.record) check.record->resource = job.id;
  context.store.create_job(job, {}, check.record);
  context.jobs.enqueue(job);
  return accepted(job);
}

http::Response get_job(Context& context, http::Request& request) {
  return json_response(200, represent(job_of(context, request)));
}

http::Response cancel_job(Context& context, http::Request& request) {
  const auto job = job_of(context, request);
  const auto cancelled = context.jobs.cancel(job.id);
  if (cancelled == jobs::Cancelled::none) refuse("conflict", "the job has ended already");
  if (cancelled == jobs::Cancelled::pending) refuse_pending(context, "the job is cancelled");
  return json_response(202, represent(job_of(context, request)));
}

http::Response get_job_events(Context& context, http::Request& request) {
  const auto& id = request.params.at("job");
  auto events = JobEvents::open(context.jobs, id);
  if (!events) refuse("not-found", "there is no job " + id);
  http::Response response;
  response.headers["Content-Type"] = "text/event-stream";
  response.headers["Cache-Control"] = "no-store";
  response.headers["X-Accel-Buffering"] = "no";
  response.body = std::shared_ptr<http::Feed>(std::move(events));
  return response;
}

}  // namespace semblante::api

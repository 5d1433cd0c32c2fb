#include <algorithm>
#include <charconv>
#include <shared_mutex>

#include <nlohmann/json.hpp>

#include "core/json/json_pointer.h"
#include "core/types/rig.h"
#include "protocol/hash/sha256.h"
#include "server/api/common.h"
#include "server/api/generated/body_members.h"
#include "server/api/generated/handlers.h"
#include "server/api/new_model.h"
#include "server/api/quota.h"
#include "server/api/sets.h"
#include "server/http/conditional.h"

namespace semblante::api {
namespace {

/// Parts of each model in a list, so that a page of 200 models stays in the order of a megabyte.
constexpr std::size_t max_listed_parts = 32;

/// Whether the role of a part can be set.
bool is_kept(const store::ModelRecord& model, std::uint32_t part) {
  return std::any_of(model.parts.begin(), model.parts.end(), [&](const auto& kept) { return kept.index == part; });
}

std::vector<store::RoleChange> role_changes(const JsonBody& roles, const store::ModelRecord& model) {
  if (!roles.is_object()) refuse("invalid-field", "roles is an object of part indices", "/roles");
  std::vector<store::RoleChange> changes;
  for (const auto& [key, value] : roles.items()) {
    const auto pointer = std::string("/roles/").append(pointer_segment(key));
    std::uint32_t part = 0;
    const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), part);
    if (error != std::errc() || end != key.data() + key.size() || part >= model.part_count ||
        key != std::to_string(part))
      refuse("invalid-field",
             "the model has the parts 0 to " + std::to_string(model.part_count) + ", the last excluded", pointer);
    if (!is_kept(model, part))
      refuse("invalid-field",
             "only the " + std::to_string(store::max_part_records) + " largest parts can be given a role", pointer);
    std::optional<std::string> role;
    if (!value.is_null()) {
      role = checked_text(value, max_name_bytes, pointer);
      if (std::find(part_role_names.begin(), part_role_names.end(), *role) == part_role_names.end())
        refuse("invalid-field", "\"" + *role + "\" is no role", pointer);
    }
    changes.emplace_back(part, std::move(role));
  }
  return changes;
}

/// A member that may be set, reset (null), or left unchanged.
template <class T, class Parse>
void read_wish(const JsonBody& frame, const char* key, const std::string& what, Parse parse, std::optional<T>& wish) {
  if (!frame.contains(key)) return;
  const JsonBody& value = frame[key];
  wish = value.is_string() ? parse(value.get<std::string>()) : std::nullopt;
  if (!wish && !value.is_null()) refuse("invalid-field", "it must be " + what, std::string("/frame/") + key);
}

FrameWish frame_wish(const JsonBody& frame, const FrameWish& before) {
  if (!frame.is_object()) refuse("invalid-field", "frame is an object of unit, up and front", "/frame");
  for (const auto& [key, value] : frame.items())
    if (std::find(body_members::frame_wish.begin(), body_members::frame_wish.end(), key) ==
        body_members::frame_wish.end())
      refuse("invalid-field", "there is no field \"" + key + "\" in a frame", "/frame/" + pointer_segment(key));
  FrameWish wish = before;
  const std::string directions = "one of +X, -X, +Y, -Y, +Z and -Z, or null";
  read_wish(frame, "unit", "one of m, dm, cm, mm and in, or null", parse_length_unit, wish.unit);
  read_wish(frame, "up", directions, parse_direction, wish.up);
  read_wish(frame, "front", directions, parse_direction, wish.front);
  if (wish.up && wish.front && !are_valid({*wish.up, *wish.front}))
    refuse("invalid-field", "up and front must lie on two axes",
           frame.contains("front") ? "/frame/front" : "/frame/up");
  return wish;
}

/// Stores the user's settings of the frame. A new unit changes only a record; new axes turn the model, which needs an
/// import. Returns that import job, if one is needed.
std::optional<store::JobRecord> edit_frame(Context& context, http::Request& request, const store::ModelRecord& model,
                                           const JsonBody& body) {
  const FrameWish wish = frame_wish(body, model.frame_wish);
  // After a failed or cancelled import the wish is not applied yet: the same request again retries it.
  const auto last_import = context.store.latest_job(model.id, jobs::ImportJob::kind_name);
  const bool is_done = last_import && last_import->state == store::JobState::done;
  const bool is_running = model.state == store::ModelState::importing;
  if (wish == model.frame_wish && (is_done || is_running)) return std::nullopt;
  if (is_running) refuse("conflict", "the model is still being imported", "/frame");
  for (const auto& kind : jobs::job_kinds) {
    if (!kind.needs_frame_to_stay) continue;
    const auto last = context.store.latest_job(model.id, kind.name);
    if (last && !store::is_final(last->state))
      refuse("conflict", "a job works on the model as it stands: wait for job " + last->id + " or cancel it", "/frame");
  }
  // Resetting the wish needs a new import, and so does a model from before frames existed.
  const bool says_unit_only =
      is_done && model.frame && wish.unit && wish.up == model.frame_wish.up && wish.front == model.frame_wish.front;
  std::optional<store::JobRecord> job;
  QuotaTurn turn;
  ModelFrame frame = model.frame.value_or(ModelFrame{});
  if (says_unit_only) {
    frame = apply_wish(std::move(frame), {wish.unit, {}, {}});
  } else {
    refuse_unless_room(context.jobs);
    if (auto taken = take_quota(context, request, {.bytes = 1, .jobs = 1})) turn.emplace(*std::move(taken));
    job = jobs::new_record(jobs::ImportJob{}, model.id, origin_of(request));
  }
  if (!context.store.edit_frame(model.id, wish, frame, job, model.revision))
    refuse("conflict", "another request changed the model at the same time: read it and try again");
  if (job) context.jobs.enqueue(*job);
  return job;
}

/// Stores the model's own sets, which take effect with the next package. An existing package is made again, unless an
/// import will remove it.
std::optional<store::JobRecord> wear(Context& context, http::Request& request, const store::ModelRecord& model,
                                     const std::vector<store::WornSet>& worn, bool package_goes) {
  auto job = package_goes ? std::nullopt : make_package_again(context, model);
  QuotaTurn turn;
  if (job) {
    refuse_unless_room(context.jobs);
    if (auto taken = take_quota(context, request, {.bytes = 1, .jobs = 1})) turn.emplace(*std::move(taken));
    job->origin = origin_of(request);
  }
  if (!context.store.edit_worn(model.id, worn, job, model.revision))
    refuse("conflict", "another request changed the model at the same time: read it and try again");
  if (job) context.jobs.enqueue(*job);
  return job;
}

http::Response full_model(Context& context, const store::ModelRecord& model) {
  auto response = json_response(200, represent(model, context.store.artefacts(model.id)));
  response.headers["ETag"] = model_etag(model);
  return response;
}

}  // namespace

http::Response list_models(Context& context, http::Request& request) {
  const auto limit = page_size(request);
  const auto after = request.query_value("after").value_or("");
  auto models = context.store.models(after, limit + 1);
  if (!models) refuse("invalid-argument", "there is no model with this id", "?after");
  answer::Models page{.models = {}, .next = cut_to_page(*models, limit)};
  for (auto& model : *models) {
    model.parts = store::largest_parts(std::move(model.parts), max_listed_parts);
    page.models.push_back(represent(model, context.store.artefacts(model.id)));
  }
  // A page of the studio asks every few seconds, and there may be megabytes of heads.
  auto response = json_response(200, page);
  response.headers["ETag"] = "\"sha256-" + sha256_hex(std::get<std::string>(response.body)) + "\"";
  return http::apply_preconditions(request, std::move(response));
}

http::Response get_model(Context& context, http::Request& request) {
  return http::apply_preconditions(request, full_model(context, model_of(context, request)));
}

http::Response patch_model(Context& context, http::Request& request) {
  const auto model = model_of(context, request);
  check_if_match(request, model_etag(model));
  const auto body = body_object(request);
  refuse_unknown_members(body, body_members::model_edit);
  std::optional<std::string> name;
  if (body.contains("name")) name = checked_text(body["name"], max_name_bytes, "/name");
  std::vector<store::RoleChange> roles;
  if (body.contains("roles")) roles = role_changes(body["roles"], model);
  std::vector<store::WornSet> worn;
  if (body.contains("expressions")) worn = worn_from_json(context, body["expressions"]);
  const bool has_more = name || !roles.empty() || !(body.contains("frame") || body.contains("expressions"));
  std::optional<store::JobRecord> import;
  auto now = model;
  if (body.contains("frame")) {
    import = edit_frame(context, request, model, body["frame"]);
    now = model_of(context, request);
  }
  // A job that ends between reading and writing changes the model too: retries, unless the client asked for a revision.
  constexpr int attempts = 8;
  for (int left = has_more ? attempts : 0; left > 0; --left) {
    if (context.store.edit_model(model.id, name, roles, now.revision)) break;
    if (left == 1 || request.header("If-Match"))
      refuse("conflict", "another request changed the model at the same time: read it and try again");
    now = model_of(context, request);
    if (body.contains("roles")) roles = role_changes(body["roles"], now);
  }
  auto job = import;
  if (!worn.empty()) job = wear(context, request, model_of(context, request), worn, import.has_value());
  if (!job) job = import;
  auto response = full_model(context, model_of(context, request));
  if (job) {
    response.status = 202;
    response.headers["Location"] = "/v1/jobs/" + job->id;
  }
  return response;
}

http::Response delete_model(Context& context, http::Request& request) {
  const auto model = model_of(context, request);
  check_if_match(request, model_etag(model));
  // Checks the disk before the model's jobs are cancelled.
  context.pending.with_reserve([&] { context.store.check_writable(); });
  context.jobs.cancel_all_of(model.id);
  const std::unique_lock alone(context.blobs.references());
  const auto orphans = context.pending.with_reserve([&] { return context.store.remove_model(model.id); });
  if (!orphans) refuse("not-found", "there is no model " + model.id);
  for (const auto& hash : *orphans) context.blobs.remove(hash);
  http::Response response;
  response.status = 204;
  return response;
}

}  // namespace semblante::api

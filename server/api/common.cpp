#include "server/api/common.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/json/json_pointer.h"
#include "core/json/read_json.h"
#include "core/types/printable.h"
#include "protocol/hash/sha256.h"
#include "server/api/authorization.h"
#include "server/http/conditional.h"
#include "server/settings/text.h"

namespace semblante::api {
namespace {

constexpr std::size_t default_page = 50;
constexpr std::size_t max_page = 200;
/// Limits the memory of a parsed body to about 20 MB; a marked head has a few thousand values.
constexpr std::size_t max_body_values = 200'000;
constexpr std::size_t max_file_name_bytes = 200;
/// A request waits on a worker thread for the request that holds its key. Both bodies have arrived already, so the wait
/// is for one creation, which depends on the disk but on no client: milliseconds, or seconds for the largest model. The
/// timeout is for a disk that hangs.
constexpr std::chrono::seconds longest_key_wait{10};

}  // namespace

void refuse(std::string_view slug, std::string detail, std::string pointer) {
  throw Refused{http::make_problem(slug, std::move(detail), std::move(pointer))};
}

void refuse(std::string_view slug, std::string detail, std::string pointer, std::optional<Advice> advice) {
  auto problem = http::make_problem(slug, std::move(detail), std::move(pointer));
  problem.advice = advice;
  throw Refused{std::move(problem)};
}

void refuse_for_now(std::string detail, unsigned retry_after) {
  throw Refused{http::make_problem("too-many-requests", std::move(detail)), retry_after};
}

std::unique_ptr<void, void (*)(void*)> export_slot(Context& context) {
  auto slot = context.exports->take();
  if (!slot) refuse_for_now("as many exports as may be made at the same time are being made; try again", 2);
  return slot;
}

store::ModelRecord model_of(Context& context, const http::Request& request) {
  const auto& id = request.params.at("model");
  auto model = context.store.model(id);
  if (!model) refuse("not-found", "there is no model " + id);
  return std::move(*model);
}

JsonBody body_object(const http::Request& request) {
  if (request.body.empty()) return JsonBody::object();
  auto json = read_json(request.body, {.max_bytes = 1U << 20U, .max_depth = 64, .max_values = max_body_values});
  if (!json) {
    const auto& where = json.error().where;
    refuse("malformed-request",
           "the body cannot be read: " + (where.empty() ? "" : where + ": ") + json.error().message, where);
  }
  if (!json->is_object()) refuse("invalid-field", "the body must be a JSON object");
  return *std::move(json);
}

void refuse_unknown_members(const JsonBody& object, std::span<const std::string_view> known) {
  for (const auto& [name, value] : object.items())
    if (std::find(known.begin(), known.end(), name) == known.end())
      refuse("invalid-field", "there is no field \"" + name + "\" here",
             std::string("/").append(pointer_segment(name)));
}

std::string checked_text(std::string_view value, std::size_t max, const std::string& pointer) {
  if (const auto good = settings::check_text(value, max); !good) refuse("invalid-field", good.error().message, pointer);
  return std::string(value);
}

std::string checked_text(const JsonBody& value, std::size_t max, const std::string& pointer) {
  if (!value.is_string()) refuse("invalid-field", "it must be a string", pointer);
  return checked_text(std::string_view(value.get_ref<const std::string&>()), max, pointer);
}

bool flag_member(const JsonBody& body, const char* name) {
  if (!body.contains(name)) return false;
  if (!body[name].is_boolean()) refuse("invalid-field", "must be true or false", std::string("/") + name);
  return body[name].get<bool>();
}

double number_or(const JsonBody& body, const char* name, double otherwise, double least, double most) {
  if (!body.contains(name)) return otherwise;
  const JsonBody& value = body[name];
  const double number = value.is_number() ? value.get<double>() : std::nan("");
  if (!(number >= least && number <= most))
    refuse("invalid-field", "it must be a number from " + Json(least).dump() + " to " + Json(most).dump(),
           std::string("/") + name);
  return number;
}

void check_if_match(const http::Request& request, const std::string& etag) {
  const auto match = request.header("If-Match");
  if (match && !http::etag_matches(*match, etag, false))
    refuse("precondition-failed", "the ETag of the resource is " + etag + " now");
}

IdempotencyCheck check_idempotency(Context& context, const http::Request& request, std::string_view body_hash) {
  const auto key = request.header("Idempotency-Key");
  if (!key) return {};
  if (key->empty() || key->size() > 200) refuse("invalid-argument", "an Idempotency-Key has 1 to 200 characters");
  std::string whole = request.method + " " + request.path;
  for (const auto& [name, value] : request.query) whole.append("&").append(name).append("=").append(value);
  whole.append("\n").append(body_hash);
  store::IdempotencyRecord record{std::string(*key), sha256_hex(whole), {}};
  auto held = context.idempotency_keys->acquire(*key, longest_key_wait);
  if (!held) refuse_for_now("another request with this Idempotency-Key is still being served", 1);
  const auto earlier = context.store.idempotency(*key);
  if (!earlier) return {std::move(record), std::nullopt, std::move(held)};
  if (earlier->fingerprint != record.fingerprint)
    refuse("idempotency-key-reused", "this Idempotency-Key was used for another request before");
  return {std::nullopt, earlier->resource, std::move(held)};
}

KeyLocks::Held take_stream_turn(Context& context, const std::string& id) {
  auto held = context.stream_changes->acquire(id, longest_key_wait);
  if (!held) refuse_for_now("another request still creates or removes the stream " + id, 1);
  return std::move(*held);
}

std::size_t page_size(const http::Request& request) {
  const auto text = request.query_value("limit");
  if (!text) return default_page;
  std::size_t limit = 0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), limit);
  if (error != std::errc() || end != text->data() + text->size() || limit == 0 || limit > max_page)
    refuse("invalid-argument", "limit is a number from 1 to " + std::to_string(max_page), "?limit");
  return limit;
}

std::string clean_file_name(std::string_view name) {
  const auto slash = name.find_last_of("/\\");
  if (slash != std::string_view::npos) name.remove_prefix(slash + 1);
  std::string clean;
  for (std::size_t at = 0; at < name.size();) {
    const std::string_view character = name.substr(at, utf8_step(name.substr(at)));
    at += character.size();
    if (at > max_file_name_bytes) break;
    if (!has_controls(character)) clean.append(character);
  }
  return clean;
}

store::Origin origin_of(const http::Request& request) { return {asking_of(request).rights.token, request.id}; }

http::Response accepted(const store::JobRecord& job) {
  auto response = json_response(202, represent(job));
  response.headers["Location"] = "/v1/jobs/" + job.id;
  return response;
}

void refuse_unless_room(const jobs::JobQueue& jobs) {
  constexpr unsigned seconds = 10;
  if (!jobs.has_room()) refuse_for_now("too many jobs are waiting", seconds);
}

void refuse_unless_imported(const store::ModelRecord& model) {
  if (model.state == store::ModelState::importing) refuse("conflict", "the model is still being imported");
  if (model.state == store::ModelState::failed) refuse("conflict", "the import of this model failed");
}

}  // namespace semblante::api

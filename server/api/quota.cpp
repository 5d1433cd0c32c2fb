#include "server/api/quota.h"

#include <algorithm>
#include <array>
#include <utility>

#include "server/api/authorization.h"
#include "server/api/common.h"
#include "server/api/generated/handlers.h"
#include "server/http/problem.h"
#include "server/recordings/recording_format.h"

namespace semblante::api {
namespace {

using access::TokenLimits;
using store::Usage;

/// A limit that is kept by counting records.
struct Row {
  std::string_view name;
  std::uint64_t TokenLimits::*limit;
  std::uint64_t Usage::*used;
  std::string_view remedy;
};

constexpr auto rows = std::to_array<Row>({
    {"bytes", &TokenLimits::bytes, &Usage::bytes, "delete models, recordings, speeches or expressions of this token"},
    {"models", &TokenLimits::models, &Usage::models, "delete models of this token"},
    {"expressions", &TokenLimits::expressions, &Usage::sets, "delete expressions of this token"},
    {"streams", &TokenLimits::streams, &Usage::streams, "delete streams of this token"},
    {"recordings", &TokenLimits::recordings, &Usage::recordings, "delete recordings of this token"},
    {"speeches", &TokenLimits::speeches, &Usage::speeches, "delete speeches of this token"},
    {"jobs", &TokenLimits::jobs, &Usage::jobs, "wait until a job of this token has ended, or cancel one"},
});
constexpr std::string_view uploads = "uploads";

constexpr unsigned retry_after_jobs = 10, retry_after_uploads = 5;
/// A creation holds its turn while its bytes are hashed and made durable.
constexpr std::chrono::seconds longest_turn{30};

std::optional<std::uint64_t> or_none(std::uint64_t limit) { return limit == 0 ? std::nullopt : std::optional(limit); }

Usage usage_of(store::OwnerStore& store, const recordings::Recorder* recorder, const std::string& token) {
  auto usage = store.usage_of(token);
  if (recorder != nullptr) usage.bytes += recorder->unstored_bytes(token);
  return usage;
}

Usage usage_of(Context& context, const std::string& token) {
  return usage_of(context.store, context.recorder.get(), token);
}

/// What a token has, by limit. `limited`: false for one without limits.
std::vector<Quota> quotas_of(Context& context, const std::string& token, bool limited) {
  const auto& security = context.config.security;
  const auto usage = usage_of(context, token);
  const auto limit = [&](std::uint64_t value) { return limited ? or_none(value) : std::nullopt; };
  std::vector<Quota> list;
  list.reserve(std::size(rows) + 1);
  for (const auto& row : rows) list.push_back({row.name, usage.*row.used, limit(security.token_limits.*row.limit)});
  list.push_back({uploads, security.uploads->of(token), limit(security.token_limits.uploads)});
  return list;
}

http::Problem reached(std::string_view slug, const Quota& quota, std::string_view remedy) {
  const auto limit = std::to_string(*quota.limit), used = std::to_string(quota.used);
  auto problem = http::make_problem(slug, "the token has reached its limit of " + limit + " " +
                                              std::string(quota.name) + ", of which it has used " + used + ": " +
                                              std::string(remedy) + ", or ask the server's administrator for more");
  problem.advice = std::nullopt;  // the sentence names what to delete, which depends on the limit
  problem.limit = http::ReachedLimit{std::string(quota.name), *quota.limit, quota.used};
  return problem;
}

}  // namespace

std::string_view level_of(const Quota& quota) {
  if (!quota.limit || static_cast<double>(quota.used) < quota_warning * static_cast<double>(*quota.limit)) return "ok";
  return quota.used < *quota.limit ? "warning" : "full";
}

std::string limited_token(const http::Request& request) {
  const auto& rights = asking_of(request).rights;
  return rights.scope < access::Scope::admin ? rights.token : std::string();
}

QuotaTurn take_quota(Context& context, http::Request& request, const Usage& more) {
  if (const auto wait = wait_for_creation(context.config.security, request))
    refuse_for_now("this address creates more than the server accepts in a minute", *wait);
  const auto token = limited_token(request);
  if (token.empty()) return std::nullopt;
  auto turn = context.quota_turns->acquire(token, longest_turn);
  if (!turn) refuse_for_now("another request of this token is still being served", 1);
  const auto usage = usage_of(context, token);
  std::string near;
  for (const auto& row : rows) {
    const auto limit = or_none(context.config.security.token_limits.*row.limit);
    const auto wanted = more.*row.used;
    Quota quota{row.name, usage.*row.used, limit};
    if (!limit) continue;
    if (wanted > 0 && (quota.used >= *limit || wanted > *limit - quota.used)) {
      const bool passes = row.used == &Usage::jobs;
      throw Refused{reached(passes ? "too-many-requests" : "quota-exceeded", quota, row.remedy),
                    passes ? retry_after_jobs : 0};
    }
    quota.used += wanted;
    // A job ends by itself; the others are used up until something is deleted.
    if (level_of(quota) == "ok" || row.used == &Usage::jobs) continue;
    near.append(near.empty() ? "" : ", ").append(quota.name).append(";used=").append(std::to_string(quota.used));
    near.append(";limit=").append(std::to_string(*limit));
  }
  if (auto* asking = std::any_cast<Asking>(&request.requester)) asking->quota_warning = std::move(near);
  return turn;
}

std::function<bool()> recording_room(Context& context, const http::Request& request) {
  const auto token = limited_token(request);
  const auto limit = context.config.security.token_limits.bytes;
  if (token.empty() || limit == 0) return {};
  return [&store = context.store, &recorder = *context.recorder, token, limit] {
    return usage_of(store, &recorder, token).bytes + recordings::chunk_head_bytes + recordings::max_chunk_bytes <=
           limit;
  };
}

std::variant<std::shared_ptr<const void>, http::Response> take_upload(const Security& security,
                                                                      const http::Request& head) {
  const auto token = limited_token(head);
  const auto limit = security.token_limits.uploads;
  if (token.empty() || limit == 0) return nullptr;
  if (auto share = security.uploads->take(token, limit)) return share;
  const auto problem =
      reached("too-many-requests", {uploads, limit, limit}, "wait until an upload of this token has ended");
  auto response = http::to_response(problem);
  response.headers["Retry-After"] = std::to_string(retry_after_uploads);
  return response;
}

void tell_quota(const http::Request& request, http::Response& response) {
  const auto& warning = asking_of(request).quota_warning;
  if (!warning.empty()) response.headers["X-Quota-Warning"] = warning;
}

http::Response get_usage(Context& context, http::Request& request) {
  const auto& rights = asking_of(request).rights;
  auto token = rights.token;
  bool limited = !limited_token(request).empty();
  if (const auto other = request.query_value("token"); other && *other != token) {
    if (rights.scope < access::Scope::admin)
      refuse("forbidden", "what another token uses is shown to tokens with the scope admin");
    const auto tokens = context.store.tokens();
    const auto found = std::find_if(tokens.begin(), tokens.end(), [&](const auto& item) { return item.id == *other; });
    if (found == tokens.end()) refuse("not-found", "there is no token " + std::string(*other), "?token");
    token = found->id;
    limited = found->scope != access::scope_name(access::Scope::admin);
  }
  answer::Usage usage{.token = text_or_null(token), .limits = {}};
  for (const auto& quota : quotas_of(context, token, limited))
    usage.limits.push_back({.name = quota.name, .used = quota.used, .limit = quota.limit, .level = level_of(quota)});
  return json_response(200, usage);
}

}  // namespace semblante::api

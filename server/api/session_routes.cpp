#include <nlohmann/json.hpp>

#include "server/api/authorization.h"
#include "server/api/common.h"
#include "server/api/generated/body_members.h"
#include "server/api/generated/handlers.h"

namespace semblante::api {
namespace {

constexpr std::size_t max_token_bytes = 200;
constexpr std::size_t max_path_bytes = 1024;
constexpr unsigned retry_after_tickets = 30;

answer::Session session_of(const ApiConfig& config, const access::Rights& rights) {
  const bool may_enter = rights.scope != access::Scope::none;
  return {.asks_for_tokens = config.security.asks_for_tokens,
          .scope = access::scope_name(rights.scope),
          .stream = text_or_null(rights.stream),
          .model = text_or_null(rights.model),
          .network_urls = may_enter ? config.network_urls() : std::vector<std::string>()};
}

/// The cookie of a browser. `__Host-` as its name would need TLS, which a server on loopback does not have.
std::string cookie(std::string_view token, bool secure, std::string_view more) {
  return std::string(session_cookie)
      .append("=")
      .append(token)
      .append("; Path=/; HttpOnly; SameSite=Strict")
      .append(secure ? "; Secure" : "")
      .append(more);
}

}  // namespace

http::Response get_session(Context& context, http::Request& request) {
  auto response = json_response(200, session_of(context.config, asking_of(request).rights));
  response.headers["Cache-Control"] = "no-store";
  return response;
}

http::Response create_session(Context& context, http::Request& request) {
  const auto body = body_object(request);
  refuse_unknown_members(body, body_members::create_session);
  if (!body.contains("token")) refuse("invalid-field", "it is required", "/token");
  const auto token = checked_text(body["token"], max_token_bytes, "/token");
  const auto& security = context.config.security;
  const auto asking = ask_with(security, asking_of(request).from, token);
  if (asking.refused == access::Verdict::busy)
    refuse_for_now("too many tokens that are not accepted were sent; wait before the next", retry_after_tickets);
  if (asking.refused == access::Verdict::expired) refuse("unauthorized", "the token has expired", "/token");
  if (asking.refused || asking.rights.scope == access::Scope::none)
    refuse("unauthorized", "the token is not accepted: it was never made, or is revoked", "/token");
  auto response = json_response(200, session_of(context.config, asking.rights));
  response.headers["Cache-Control"] = "no-store";
  if (security.asks_for_tokens) response.headers["Set-Cookie"] = cookie(token, asking_of(request).from.secure, "");
  return response;
}

http::Response delete_session(Context&, http::Request& request) {
  http::Response response;
  response.status = 204;
  response.headers["Set-Cookie"] = cookie("", asking_of(request).from.secure, "; Max-Age=0");
  return response;
}

http::Response create_ticket(Context& context, http::Request& request) {
  const auto body = body_object(request);
  refuse_unknown_members(body, body_members::create_ticket);
  if (!body.contains("path")) refuse("invalid-field", "it is required", "/path");
  auto path = checked_text(body["path"], max_path_bytes, "/path");
  if (path.front() != '/') refuse("invalid-field", "it begins with /", "/path");
  auto ticket = context.config.security.tickets->issue(asking_of(request).rights, std::move(path));
  if (!ticket) refuse_for_now("too many tickets are waiting to be used", retry_after_tickets);
  auto response =
      json_response(201, answer::Ticket{.ticket = std::move(*ticket),
                                        .expires_in = static_cast<std::uint64_t>(access::Tickets::lifetime.count())});
  response.headers["Cache-Control"] = "no-store";
  return response;
}

}  // namespace semblante::api

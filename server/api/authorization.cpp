#include "server/api/authorization.h"

#include <algorithm>
#include <array>

#include "core/types/letter_case.h"
#include "server/api/access.h"
#include "server/api/common.h"
#include "server/api/generated/handlers.h"
#include "server/api/routes.h"
#include "server/http/media_type.h"
#include "server/http/problem.h"

namespace semblante::api {
namespace {

using access::Rights;
using access::Scope;
using access::Verdict;
using http::make_problem;

constexpr unsigned retry_after_rate = 1, retry_after_failures = 30;

/// "a=1; semblante_session=x" -> "x".
std::string_view cookie_of(const http::Request& head) {
  auto rest = head.header("Cookie").value_or("");
  while (!rest.empty()) {
    const auto end = std::min(rest.find(';'), rest.size());
    auto pair = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    while (!pair.empty() && pair.front() == ' ') pair.remove_prefix(1);
    const auto is = pair.find('=');
    if (is != std::string_view::npos && pair.substr(0, is) == session_cookie) return pair.substr(is + 1);
  }
  return {};
}

bool only_reads(const http::Request& head, bool is_upgrade) {
  return !is_upgrade && (head.method == "GET" || head.method == "HEAD");
}

/// A browser sends cookies without being asked, so a page of another origin must not profit from them (CSRF). Reading
/// requests of such a page do not carry a SameSite=Strict cookie, and their answers cannot be read; requests that
/// change something, and WebSockets, must come from the server's own pages.
bool may_use_cookie(const http::Request& head, bool is_upgrade) {
  const auto origin = head.header("Origin");
  if (!origin) return only_reads(head, is_upgrade);
  return is_own_origin(head);
}

/// The token that a request carries in a header; empty without one.
std::string token_of(const http::Request& head, bool is_upgrade) {
  constexpr std::string_view bearer = "Bearer ";
  if (const auto value = head.header("Authorization"); value && value->size() > bearer.size()) {
    if (equal_ignoring_case(value->substr(0, bearer.size()), bearer)) return std::string(value->substr(bearer.size()));
  }
  if (is_upgrade)
    for (const auto& name : http::split_list(head.header("Sec-WebSocket-Protocol").value_or("")))
      if (name.starts_with(bearer_subprotocol)) return name.substr(bearer_subprotocol.size());
  if (may_use_cookie(head, is_upgrade)) return std::string(cookie_of(head));
  return {};
}

/// The key by which requests without a token are counted.
std::string network_of(const std::string& address) {
  const auto bytes = http::parse_address(address);
  if (!bytes) return address;
  const auto network = http::client_network(*bytes);
  return {network.begin(), network.end()};
}

std::string client_of(const Asking& asking) {
  return asking.rights.token.empty() ? "@" + network_of(asking.from.address) : asking.rights.token;
}

http::Response too_many(std::string detail, unsigned retry_after) {
  auto response = http::to_response(make_problem("too-many-requests", std::move(detail)));
  response.headers["Retry-After"] = std::to_string(retry_after);
  return response;
}

http::Response unauthorized(std::string detail, std::string_view error) {
  auto response = http::to_response(make_problem("unauthorized", std::move(detail)));
  std::string challenge = "Bearer realm=\"semblante\"";
  if (!error.empty()) challenge.append(", error=\"").append(error).append("\"");
  response.headers["WWW-Authenticate"] = std::move(challenge);
  return response;
}

std::string_view param(const http::Request& head, const std::string& name) {
  const auto found = head.params.find(name);
  return found == head.params.end() ? std::string_view() : std::string_view(found->second);
}

bool shows(const streams::StreamInfo& stream, std::string_view model) {
  return !model.empty() && stream.settings.model == model;
}

/// What a client fetches to show the model of a stream.
bool is_of_a_face(Handler handler) {
  constexpr std::array<Handler, 8> handlers = {get_stream, get_model,   get_mesh, get_weights,
                                               get_rig,    get_preview, get_face, get_artefact};
  return std::find(handlers.begin(), handlers.end(), handler) != handlers.end();
}

Handler handler_of(const http::Request& head) {
  return head.route < routes().size() ? routes()[head.route].handler : nullptr;
}

/// Whether the path is one of a stream, a model or an artefact that a public stream opens for reading.
bool is_public(streams::StreamHub& hub, const http::Request& head) {
  if (!is_of_a_face(handler_of(head))) return false;
  if (const auto stream = param(head, "stream"); !stream.empty()) {
    const auto info = hub.info(stream);
    return info && info->settings.is_public;
  }
  const auto streams = hub.list();
  const bool any_artefact = !param(head, "sha256").empty();
  return std::any_of(streams.begin(), streams.end(), [&](const auto& stream) {
    return stream.settings.is_public && (any_artefact || shows(stream, param(head, "model")));
  });
}

/// Whether a token for one stream or model is accepted by this path. Paths of jobs and recordings are left to
/// refuse_foreign_resource().
bool covers(const Rights& rights, streams::StreamHub& hub, const http::Request& head, Scope needed) {
  // A ticket has the same rights; its own use is each token's business.
  if (handler_of(head) == create_ticket || handler_of(head) == get_usage) return true;
  const auto may_read = [&](std::string_view model) {
    if (rights.stream.empty()) return model == rights.model;
    const auto info = hub.info(rights.stream);
    return info && shows(*info, model);
  };
  if (const auto other = head.query_value("model"); other && !may_read(*other)) return false;
  if (!param(head, "job").empty() || !param(head, "recording").empty()) return true;
  // Named by their own hash: who knows it has had the bytes, or the document that names them.
  if (!param(head, "sha256").empty()) return true;
  const auto stream = param(head, "stream"), model = param(head, "model");
  if (!rights.stream.empty()) {
    if (!stream.empty()) return stream == rights.stream;
    return needed <= Scope::read && may_read(model);
  }
  return !model.empty() && model == rights.model;
}

std::string in_words(const Rights& rights) {
  return rights.stream.empty() ? "the model " + rights.model : "the stream " + rights.stream;
}

[[noreturn]] void refuse_other(const Rights& rights) {
  refuse("forbidden", "the token is for " + in_words(rights) + " only");
}

}  // namespace

Asking ask(const Security& security, const http::Request& head, bool is_upgrade) {
  Asking asking{access::requester_of(head, security.proxies), {}, {}};
  const auto ticket = head.query_value("ticket");
  if (security.asks_for_tokens && ticket && (is_upgrade || only_reads(head, is_upgrade))) {
    if (auto rights = security.tickets->redeem(*ticket, head.path))
      asking.rights = std::move(*rights);
    else
      asking.refused = Verdict::unknown;
    return asking;
  }
  return ask_with(security, std::move(asking.from), token_of(head, is_upgrade));
}

Asking ask_with(const Security& security, access::Requester from, std::string_view token) {
  Asking asking{std::move(from), {}, {}};
  if (!security.asks_for_tokens) {
    asking.rights.scope = Scope::admin;
    return asking;
  }
  if (token.empty()) return asking;
  const auto network = network_of(asking.from.address);
  if (!security.rates->may_try(network)) {
    asking.refused = Verdict::busy;
    return asking;
  }
  auto verified = security.tokens->verify(token);
  if (verified.verdict == Verdict::accepted) {
    asking.rights = std::move(verified.rights);
    return asking;
  }
  if (verified.verdict != Verdict::busy) security.rates->count_failure(network);
  asking.refused = verified.verdict;
  return asking;
}

const Asking& asking_of(const http::Request& request) {
  static const Asking nobody;
  const auto* asking = std::any_cast<Asking>(&request.requester);
  return asking == nullptr ? nobody : *asking;
}

std::optional<http::Response> refuse_bypass(const Security& security, const http::Request& head) {
  if (security.proxies.empty() || head.secure || http::any_contains(security.proxies, head.peer)) return std::nullopt;
  const auto peer = http::parse_address(head.peer);
  if (peer && http::is_loopback(*peer)) return std::nullopt;
  return http::to_response(make_problem("forbidden", "this server is reached through its proxy, with TLS"));
}

std::optional<http::Response> refuse_rate(const Security& security, const http::Request& head) {
  if (!security.asks_for_tokens || security.rates->take_request(client_of(asking_of(head)))) return std::nullopt;
  return too_many("this client sends more requests than the server accepts", retry_after_rate);
}

std::optional<unsigned> wait_for_creation(const Security& security, const http::Request& request) {
  const auto& asking = asking_of(request);
  const bool is_admin = !asking.rights.token.empty() && asking.rights.scope >= Scope::admin;
  const auto address = http::parse_address(asking.from.address);
  if (is_admin || !address || http::is_loopback(*address)) return std::nullopt;
  if (security.rates->take_creation(network_of(asking.from.address))) return std::nullopt;
  return security.rates->seconds_per_creation();
}

std::optional<http::Response> refuse_access(const Security& security, streams::StreamHub& hub,
                                            const http::Request& head, Scope needed) {
  if (!security.asks_for_tokens) return std::nullopt;
  const auto& asking = asking_of(head);
  if (needed == Scope::none) return std::nullopt;
  if (asking.refused == Verdict::busy)
    return too_many("too many tokens that are not accepted were sent; wait before the next", retry_after_failures);
  if (asking.refused == Verdict::expired) return unauthorized("the token has expired", "invalid_token");
  if (asking.refused)
    return unauthorized("the token is not accepted: it was never made, is revoked, or a ticket that is used up",
                        "invalid_token");
  const auto& rights = asking.rights;
  if (rights.scope == Scope::none) {
    if (needed == Scope::read && is_public(hub, head)) return std::nullopt;
    return unauthorized("this request needs a token with the scope " + std::string(access::scope_name(needed)) +
                            "; send it as Authorization: Bearer <token>",
                        {});
  }
  if (rights.scope < needed)
    return http::to_response(
        make_problem("forbidden", "this request needs the scope " + std::string(access::scope_name(needed)) +
                                      ", and the token has " + std::string(access::scope_name(rights.scope))));
  if (rights.limited() && !covers(rights, hub, head, needed))
    return http::to_response(make_problem("forbidden", "the token is for " + in_words(rights) + " only"));
  return std::nullopt;
}

std::optional<http::Response> refuse_ended_token(const http::Request& request) {
  const auto& ended = asking_of(request).rights.ended;
  if (!ended || !*ended) return std::nullopt;
  return unauthorized("the token was revoked or has expired", "invalid_token");
}

void refuse_foreign_resource(Context& context, const http::Request& request) {
  const auto& rights = asking_of(request).rights;
  if (const auto id = param(request, "job"); !id.empty() && rights.limited()) {
    const auto job = context.store.job(id);
    if (rights.model.empty() || !job || job->model != rights.model) refuse_other(rights);
  }
  if (const auto id = param(request, "recording"); !id.empty()) refuse_foreign_recording(context, request, id);
}

void refuse_foreign_recording(Context& context, const http::Request& request, std::string_view id) {
  const auto& rights = asking_of(request).rights;
  if (!rights.limited()) return;
  const auto recording = context.store.recording(id);
  if (rights.stream.empty() || !recording || recording->stream != rights.stream) refuse_other(rights);
}

std::optional<http::Response> refuse_entry(const Security& security, const http::Request& head) {
  if (auto elsewhere = redirect_to_https(security, head)) return elsewhere;
  if (auto refusal = refuse_bypass(security, head)) return refusal;
  return refuse_rate(security, head);
}

std::optional<http::Response> redirect_to_https(const Security& security, const http::Request& head) {
  if (!security.https_port || asking_of(head).from.secure) return std::nullopt;
  // What watches the server asks from this machine, without a certificate.
  if (const auto asked = handler_of(head); asked == get_health || asked == get_ready) return std::nullopt;
  std::string host(head.header("Host").value_or("localhost"));
  // Access has checked that it is a host with an optional port.
  const auto end = host.find(':', host.starts_with('[') ? std::min(host.find(']'), host.size()) : 0);
  if (end != std::string::npos) host.resize(end);
  constexpr std::uint16_t usual_port = 443;
  if (*security.https_port != usual_port) host.append(":").append(std::to_string(*security.https_port));
  http::Response response;
  response.status = 308;
  response.headers["Location"] = "https://" + host + head.target;
  return response;
}

}  // namespace semblante::api

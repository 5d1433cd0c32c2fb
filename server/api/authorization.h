#pragma once

#include <optional>
#include <string_view>

#include "server/access/requester.h"
#include "server/access/rights.h"
#include "server/access/scope.h"
#include "server/access/token_registry.h"
#include "server/api/security.h"
#include "server/http/message.h"
#include "server/streams/stream_hub.h"

namespace semblante::api {

struct Context;

/// The requester of a request, kept in http::Request::requester.
struct Asking {
  access::Requester from;
  access::Rights rights;
  std::optional<access::Verdict> refused;  ///< of a token that was sent and not accepted
  std::string quota_warning = {};          ///< limits of the token that are nearly reached (quota.h)
};

/// What find_route() finds out: address, and the rights of the token, ticket or cookie. Uses a ticket up.
Asking ask(const Security& security, const http::Request& head, bool is_upgrade);
/// The same for a token that a body carries.
Asking ask_with(const Security& security, access::Requester from, std::string_view token);
/// The Asking in a request; one without rights when there is none.
const Asking& asking_of(const http::Request& request);

/// The answer to a request without TLS that has not come through a proxy, on a server that is reached through proxies;
/// nullopt when it may go on. Requests of this machine may.
std::optional<http::Response> refuse_bypass(const Security& security, const http::Request& head);
/// The answer to a client that sends too many requests; nullopt when it may go on.
std::optional<http::Response> refuse_rate(const Security& security, const http::Request& head);
/// Counts a creation of the requester's address: after how many seconds it may be tried again if there were too many.
/// Creations by this machine, and with a token of the scope admin, are not counted.
std::optional<unsigned> wait_for_creation(const Security& security, const http::Request& request);
/// The answer to a request that its sender may not make; nullopt when it may go on. Does not wait: jobs and recordings
/// of tokens for one stream or model are checked by refuse_foreign_resource(). `needed`: of the route, or of the role
/// on a stream.
std::optional<http::Response> refuse_access(const Security& security, streams::StreamHub& hub,
                                            const http::Request& head, access::Scope needed);
/// The answer to a request whose token was revoked or has expired while the body came, which may take minutes.
std::optional<http::Response> refuse_ended_token(const http::Request& request);
/// Throws Refused when the token is for another stream or model than the job or recording in the path. On a worker.
void refuse_foreign_resource(Context& context, const http::Request& request);
/// The same for a recording that a body names.
void refuse_foreign_recording(Context& context, const http::Request& request, std::string_view id);

/// The answer to a request that does not get in, whatever it asks for: it is redirected to https, or refused by
/// refuse_bypass() or refuse_rate(). nullopt when it may go on.
std::optional<http::Response> refuse_entry(const Security& security, const http::Request& head);

/// The redirection to https; nullopt when the request has come by TLS, or no such port is open.
std::optional<http::Response> redirect_to_https(const Security& security, const http::Request& head);

/// Name of the cookie with a browser's token.
inline constexpr std::string_view session_cookie = "semblante_session";
/// Subprotocol "semblante.bearer.<token>" of a WebSocket.
inline constexpr std::string_view bearer_subprotocol = "semblante.bearer.";

}  // namespace semblante::api

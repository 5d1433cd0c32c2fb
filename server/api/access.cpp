#include "server/api/access.h"

#include <algorithm>

#include <arpa/inet.h>

namespace semblante::api {
namespace {

/// "localhost:8080" -> "localhost", "[::1]:8080" -> "::1". A text that is not an authority gives a result that no list
/// contains.
std::string host_of(std::string_view authority) {
  if (!authority.empty() && authority.front() == '[') {
    const auto end = authority.find(']');
    return std::string(end == std::string_view::npos ? authority : authority.substr(1, end - 1));
  }
  return std::string(authority.substr(0, authority.find(':')));
}

bool is_loopback(const std::string& host) {
  in_addr four{};
  in6_addr six{};
  if (inet_pton(AF_INET, host.c_str(), &four) == 1) return (ntohl(four.s_addr) >> 24U) == 127U;
  if (inet_pton(AF_INET6, host.c_str(), &six) == 1) return IN6_IS_ADDR_LOOPBACK(&six);
  return http::equal_ignoring_case(host, "localhost");
}

/// True for "http://localhost:5173" and the like: pages that this machine serves.
bool is_loopback_origin(std::string_view origin) {
  const auto scheme = origin.find("://");
  return scheme != std::string_view::npos && is_loopback(host_of(origin.substr(scheme + 3)));
}

}  // namespace

std::optional<http::Problem> Access::refuse_reading(const http::Request& head) const {
  const auto authority = head.header("Host");
  if (!authority) return std::nullopt;  // HTTP/1.0; every browser sends a Host
  const auto host = host_of(*authority);
  const bool known = is_loopback(host) || std::any_of(hosts.begin(), hosts.end(), [&](const auto& item) {
                       return item == "*" || http::equal_ignoring_case(item, host);
                     });
  if (known) return std::nullopt;
  return http::make_problem(
      "foreign-host", "this server does not accept the host name " + std::string(*authority) + " (see --allow-host)");
}

std::optional<http::Problem> Access::refuse_changing(const http::Request& head) const {
  if (auto problem = refuse_reading(head)) return problem;
  if (origin_allowed(head)) return std::nullopt;
  return http::make_problem("forbidden-origin", "pages from " + std::string(*head.header("Origin")) +
                                                    " may not change anything here (see --allow-origin)");
}

bool Access::origin_allowed(const http::Request& head) const {
  const auto origin = head.header("Origin");
  if (!origin || is_loopback_origin(*origin)) return true;
  return std::any_of(origins.begin(), origins.end(), [&](const auto& item) { return item == "*" || item == *origin; });
}

}  // namespace semblante::api

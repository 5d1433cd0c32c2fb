#include "server/api/access.h"

#include <algorithm>

#include "core/types/letter_case.h"
#include "server/http/address_range.h"

namespace semblante::api {
namespace {

/// "localhost:8080" -> "localhost", "[::1]:8080" -> "::1", "localhost." -> "localhost" (the root of DNS); nullopt if
/// the text is not a host with an optional port, such as "localhost:80@example.org".
std::optional<std::string> host_of(std::string_view authority) {
  const bool bracketed = !authority.empty() && authority.front() == '[';
  const auto end = bracketed ? authority.find(']') : authority.find(':');
  if (bracketed && end == std::string_view::npos) return std::nullopt;
  auto host = bracketed ? authority.substr(1, end - 1) : authority.substr(0, end);
  auto port = authority.substr(std::min(authority.size(), bracketed ? end + 1 : host.size()));
  if (!bracketed && host.ends_with('.')) host.remove_suffix(1);
  if (!port.empty() && port.front() != ':') return std::nullopt;
  if (!port.empty()) port.remove_prefix(1);
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto is_part_of_host = [&](char c) {
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '.' || c == '_' ||
           (bracketed && c == ':');
  };
  if (host.empty() || !std::all_of(host.begin(), host.end(), is_part_of_host) ||
      !std::all_of(port.begin(), port.end(), is_digit))
    return std::nullopt;
  return std::string(host);
}

bool is_loopback(const std::string& host) {
  if (const auto address = http::parse_address(host)) return http::is_loopback(*address);
  return equal_ignoring_case(host, "localhost");
}

}  // namespace

bool is_own_origin(const http::Request& head) {
  const auto origin = head.header("Origin"), host = head.header("Host");
  if (!origin || !host) return false;
  const auto scheme = origin->find("://");
  return scheme != std::string_view::npos && host_of(*host) && equal_ignoring_case(origin->substr(scheme + 3), *host);
}

bool CertificateNames::contains(std::string_view name) const {
  const std::lock_guard lock(mutex_);
  return std::any_of(names_.begin(), names_.end(), [&](const auto& known) { return equal_ignoring_case(known, name); });
}

std::optional<http::Problem> Access::refuse_reading(const http::Request& head) const {
  const auto authority = head.header("Host");
  if (!authority) return std::nullopt;  // HTTP/1.0; every browser sends a Host
  const auto host = host_of(*authority);
  const bool known = host && (is_loopback(*host) || certificate->contains(*host) ||
                              std::any_of(hosts.begin(), hosts.end(), [&](const auto& item) {
                                return item == "*" || equal_ignoring_case(item, *host);
                              }));
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
  if (!origin || is_own_origin(head)) return true;
  return std::any_of(origins.begin(), origins.end(), [&](const auto& item) { return item == "*" || item == *origin; });
}

}  // namespace semblante::api

#include "server/api/routes.h"

namespace semblante::api {
namespace {

/// Removes one segment from the front: "/a/b" -> "a", leaving "/b".
std::string_view next_segment(std::string_view& path) {
  path.remove_prefix(1);
  const auto end = path.find('/');
  const auto segment = path.substr(0, end);
  path.remove_prefix(segment.size());
  return segment;
}

bool fits(std::string_view pattern, std::string_view path, std::map<std::string, std::string>& params) {
  params.clear();
  while (!pattern.empty() && !path.empty()) {
    const auto expected = next_segment(pattern);
    const auto actual = next_segment(path);
    if (expected.size() > 2 && expected.front() == '{') {
      if (actual.empty()) return false;
      params[std::string(expected.substr(1, expected.size() - 2))] = std::string(actual);
    } else if (expected != actual) {
      return false;
    }
  }
  return pattern.empty() && path.empty();
}

}  // namespace

Match match_route(std::string_view method, std::string_view path) {
  if (method == "HEAD") method = "GET";
  Match match;
  if (path == "*") {
    match.allow = "OPTIONS, GET, HEAD";
    for (const auto& route : routes())
      if (match.allow.find(route.method) == std::string::npos) match.allow.append(", ").append(route.method);
    return match;
  }
  std::map<std::string, std::string> params;
  for (const auto& route : routes()) {
    if (!fits(route.pattern, path, params)) continue;
    match.allow.append(match.allow.empty() ? "OPTIONS, " : ", ").append(route.method);
    if (route.method == "GET") match.allow.append(", HEAD");
    if (route.method == method) match.route = &route;
    match.params = params;
  }
  return match;
}

}  // namespace semblante::api

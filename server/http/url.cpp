#include "server/http/url.h"

#include <algorithm>

#include "core/types/letter_case.h"
#include "core/types/percent_decode.h"
#include "server/http/message.h"

namespace semblante::http {
std::optional<Target> parse_target(std::string_view target) {
  if (target.empty() || target.front() != '/') return std::nullopt;
  target = target.substr(0, target.find('#'));
  const auto mark = target.find('?');
  Target result;
  const auto written = target.substr(0, mark);
  auto path = percent_decode(written);
  // A slash within a name: a proxy that permits some paths only would see another path than the one that is served.
  if (!path || std::count(path->begin(), path->end(), '/') != std::count(written.begin(), written.end(), '/'))
    return std::nullopt;
  result.path = std::move(*path);
  if (mark == std::string_view::npos) return result;

  std::string_view rest = target.substr(mark + 1);
  while (!rest.empty()) {
    const auto end = rest.find('&');
    const auto pair = rest.substr(0, end);
    rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
    if (pair.empty()) continue;
    const auto equals = pair.find('=');
    auto key = percent_decode(pair.substr(0, equals), true);
    auto value = equals == std::string_view::npos ? std::optional<std::string>("")
                                                  : percent_decode(pair.substr(equals + 1), true);
    if (!key || !value) return std::nullopt;
    const auto [at, is_new] = result.query.try_emplace(std::move(*key), std::move(*value));
    if (!is_new && result.repeated.empty()) result.repeated = at->first;
  }
  return result;
}

std::optional<AbsoluteTarget> absolute_target(std::string_view target) {
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (!equal_ignoring_case(target.substr(0, scheme.size()), scheme)) continue;
    target.remove_prefix(scheme.size());
    const std::string_view authority = target.substr(0, target.find_first_of("/?#"));
    if (authority.empty()) return std::nullopt;
    target.remove_prefix(authority.size());
    return AbsoluteTarget{authority, (target.starts_with('/') ? "" : "/") + std::string(target)};
  }
  return std::nullopt;
}

}  // namespace semblante::http

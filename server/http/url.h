#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace semblante::http {

/// The parts of a request target in origin form.
struct Target {
  std::string path;  ///< percent-decoded; starts with '/'
  std::map<std::string, std::string> query;
  std::string repeated;  ///< a key that occurs more than once; `query` has its first value. Empty: none does
};

/// nullopt for anything that is not an origin-form target: no leading '/', a broken escape, a NUL byte.
std::optional<Target> parse_target(std::string_view target);

/// A target in absolute form, as clients send it to proxies (RFC 9112, 3.2.2): "http://host:80/path?query".
struct AbsoluteTarget {
  std::string_view authority;  ///< what Host would say; not checked
  std::string rest;            ///< the target in origin form; not checked
};

/// nullopt if the target is not in absolute form of http or https. An empty path is "/".
std::optional<AbsoluteTarget> absolute_target(std::string_view target);

}  // namespace semblante::http

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
};

/// nullopt for anything that is not an origin-form target: no leading '/', a broken escape, a NUL byte.
std::optional<Target> parse_target(std::string_view target);

}  // namespace semblante::http

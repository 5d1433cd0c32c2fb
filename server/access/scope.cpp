#include "server/access/scope.h"

#include <array>

namespace semblante::access {
namespace {

constexpr std::array<std::string_view, 5> names = {"none", "read", "publish", "edit", "admin"};

}  // namespace

std::string_view scope_name(Scope scope) { return names[static_cast<std::size_t>(scope)]; }

std::optional<Scope> parse_scope(std::string_view name) {
  for (std::size_t i = 1; i < names.size(); ++i)
    if (names[i] == name) return static_cast<Scope>(i);
  return std::nullopt;
}

}  // namespace semblante::access

#include "server/access/scope.h"

namespace semblante::access {

std::string token_scopes_in_words() {
  std::string words;
  for (std::size_t i = 1; i < scope_names.size(); ++i)
    words.append(i == 1 ? "" : i + 1 == scope_names.size() ? " or " : ", ").append(scope_names[i]);
  return words;
}

std::optional<Scope> parse_scope(std::string_view name) {
  for (std::size_t i = 1; i < scope_names.size(); ++i)
    if (scope_names[i] == name) return static_cast<Scope>(i);
  return std::nullopt;
}

}  // namespace semblante::access

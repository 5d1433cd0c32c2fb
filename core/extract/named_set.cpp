#include "core/extract/named_set.h"

namespace semblante {

std::string_view to_string(SetKind kind) { return set_kind_names[static_cast<std::size_t>(kind)]; }

std::optional<SetKind> parse_set_kind(std::string_view name) {
  for (std::size_t i = 0; i < set_kind_names.size(); ++i)
    if (set_kind_names[i] == name) return static_cast<SetKind>(i);
  return std::nullopt;
}

}  // namespace semblante

#include <cassert>

#include "core/bridges/arkit.h"
#include "core/bridges/generated/arkit_tables.h"
#include "core/types/letter_case.h"

namespace semblante {

std::string_view arkit_name(std::size_t index) {
  assert(index < arkit_count);
  return generated::arkit_shapes[index].name;
}

std::optional<std::size_t> find_arkit(std::string_view name) {
  if (name.empty()) return std::nullopt;
  const char first = lower_case(name[0]);
  for (std::size_t i = 0; i < arkit_count; ++i) {
    const std::string_view known = generated::arkit_shapes[i].name;
    if (known[0] == first && known.substr(1) == name.substr(1)) return i;
  }
  return std::nullopt;
}

std::size_t arkit_mirror(std::size_t index) {
  assert(index < arkit_count);
  return generated::arkit_shapes[index].mirror;
}

}  // namespace semblante

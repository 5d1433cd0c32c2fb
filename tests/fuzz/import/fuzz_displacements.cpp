#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "core/import/displacements_file.h"

// What is read is in order and finite.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto all = semblante::parse_displacements({reinterpret_cast<const char*>(data), size});
  if (!all) {
    if (all.error().message.empty()) std::abort();
    return 0;
  }
  if (all->empty()) std::abort();
  for (std::size_t i = 0; i < all->size(); ++i) {
    const auto& [point, value] = (*all)[i];
    if (i > 0 && !((*all)[i - 1].first < point)) std::abort();
    for (int axis = 0; axis < 3; ++axis)
      if (!std::isfinite(value[axis])) std::abort();
  }
  return 0;
}

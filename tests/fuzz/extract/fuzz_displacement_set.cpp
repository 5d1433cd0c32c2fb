#include <cmath>

#include "core/extract/set_file.h"

// What is read is bounded and in order, and reads the same when it is written.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace semblante;
  static_cast<void>(parse_set_displacements({reinterpret_cast<const char*>(data), size}));
  const auto set = parse_displacement_set({reinterpret_cast<const char*>(data), size});
  if (!set) return 0;
  for (std::size_t i = 0; i < set->displacements.size(); ++i) {
    const Displacement& d = set->displacements[i];
    if (i > 0 && !(set->displacements[i - 1].point < d.point)) __builtin_trap();
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(d.value[axis]) <= most_set_units)) __builtin_trap();
  }
  const auto back = parse_displacement_set(write_displacement_set(*set));
  if (!back || back->name != set->name || back->displacements.size() != set->displacements.size()) __builtin_trap();
  for (std::size_t i = 0; i < set->displacements.size(); ++i)
    if (back->displacements[i].value != set->displacements[i].value) __builtin_trap();
  return 0;
}

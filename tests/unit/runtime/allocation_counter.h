#pragma once

#include <cstddef>

namespace semblante::testing {

/// Number of allocations by C++ in this process so far: a program with allocation_counter.cpp counts them all.
std::size_t allocation_count();

}  // namespace semblante::testing

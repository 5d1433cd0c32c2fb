#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <malloc.h>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tests/support/thread_time.h"

namespace semblante::test {

/// Sizes of the inputs of expect_linear(), in whatever `make` counts.
struct Growth {
  std::size_t from = 1000;     ///< the smallest that is tried
  std::size_t most = 400'000;  ///< the largest; below the limits of the reader, or the limit would be measured
};

/// Expects that reading an input of eight times the size takes at most 24 times the processor time: work in proportion
/// to the size takes 8 times, by its square 64 times. The size is doubled until reading takes 4 ms, so that the factor
/// is no accident of the clock; where the largest size takes less than 24 times that, it is cheap whatever its growth.
/// Memory is kept from one reading to the next, so that the kernel's work on fresh pages is not measured.
///
/// `make(size)` makes the input, unmeasured; `read(input)` reads it on this thread, accepted or refused. `what` names
/// the shape in failures.
template <class Make, class Read>
void expect_linear(const std::string& what, const Growth& growth, Make make, Read read) {
  constexpr std::size_t times = 8;
  constexpr double most_times = 24.0;
  constexpr double measurable_ms = 4.0;
  constexpr int repetitions = 3;
  static const bool keeps_memory =
      mallopt(M_MMAP_MAX, 0) != 0 && mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max()) != 0;
  (void)keeps_memory;
  const auto least_ms = [&](std::size_t size) {
    double least = 0.0;
    const auto input = make(size);
    for (int i = 0; i < repetitions; ++i) {
      const double begin = thread_cpu_ms();
      read(input);
      const double took = thread_cpu_ms() - begin;
      least = i == 0 ? took : std::min(least, took);
    }
    return least;
  };
  std::size_t size = std::min(growth.from, growth.most / times);
  double small = least_ms(size);
  while (small < measurable_ms && size * 2 * times <= growth.most) {
    size *= 2;
    small = least_ms(size);
  }
  const double large = least_ms(size * times);
  EXPECT_LE(large, most_times * std::max(small, measurable_ms))
      << what << ": " << size << " take " << small << " ms, " << size * times << " take " << large << " ms";
}

}  // namespace semblante::test

// The loops of DistanceKernel over a type `Lanes` that the including file defines first. Files that include this are
// compiled for registers which the machine may not have, so nothing but C headers may come in here: an inline function
// of the standard library would be compiled for those registers too, and the linker might keep that copy for everyone.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/geometry/distance_kernel.h"

namespace semblante {
namespace {

inline void visit(const DistanceGroup& g, std::size_t position) {
  constexpr std::size_t width = DistanceGroup::lane_count;
  const std::uint32_t vertex = g.order[position];
  const std::uint32_t first = g.offsets[vertex];
  const std::uint32_t end = g.offsets[vertex + 1];
  Lanes here = Lanes::load(g.distances + vertex * width);
  for (std::uint32_t k = first; k < end; ++k) {
    here.lower_to(Lanes::load(g.distances + g.to[k] * width), g.lengths[k]);
  }
  here.store(g.distances + vertex * width);
  g.pending[position] = 0;
  // No branch: whether a neighbour improves is as good as random, and a wrong guess costs more than the store.
  for (std::uint32_t k = first; k < end; ++k) {
    g.pending[g.place[g.to[k]]] |= here.improves(Lanes::load(g.distances + g.to[k] * width), g.lengths[k]);
  }
}

inline bool none_pending(const std::uint8_t* eight) {
  std::uint64_t word = 0;
  __builtin_memcpy(&word, eight, sizeof word);
  return word == 0;
}

std::size_t sweep(const DistanceGroup& g, std::size_t count, bool forward) {
  constexpr std::size_t ahead = 6;
  std::size_t visits = 0;
  if (forward) {
    for (std::size_t k = 0; k < count;) {
      if (k % 8 == 0 && none_pending(g.pending + k)) {
        k += 8;
        continue;
      }
      if (g.pending[k] != 0) {
        const std::uint32_t soon = g.order[k + ahead < count ? k + ahead : k];
        __builtin_prefetch(g.distances + soon * DistanceGroup::lane_count);
        visit(g, k);
        ++visits;
      }
      ++k;
    }
    return visits;
  }
  for (std::size_t k = count; k > 0;) {
    if (k % 8 == 0 && none_pending(g.pending + k - 8)) {
      k -= 8;
      continue;
    }
    --k;
    if (g.pending[k] != 0) {
      visit(g, k);
      ++visits;
    }
  }
  return visits;
}

std::size_t sweep_list(const DistanceGroup& g, const std::uint32_t* positions, std::size_t count, bool forward) {
  std::size_t visits = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint32_t position = positions[forward ? k : count - 1 - k];
    if (g.pending[position] == 0) continue;
    visit(g, position);
    ++visits;
  }
  return visits;
}

}  // namespace
}  // namespace semblante

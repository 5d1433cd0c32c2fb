// The loops of DistanceKernel over a type `Lanes` of eight doubles, which the including file defines first. Including
// files are compiled for instruction sets that the machine may not have, so only C headers may be included: an inline
// function of the standard library would be compiled for that instruction set too, and the linker might use that copy
// in the whole program.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/geometry/distance_kernel.h"

namespace semblante {
namespace {

/// The values of a vertex for all lanes.
struct Row {
  static constexpr std::size_t count = DistanceGroup::lane_count / 8;
  Lanes part[count];

  static Row load(const double* from) {
    Row row;
    for (std::size_t i = 0; i < count; ++i) row.part[i] = Lanes::load(from + 8 * i);
    return row;
  }
  void store(double* to) const {
    for (std::size_t i = 0; i < count; ++i) part[i].store(to + 8 * i);
  }
  void lower_to(const Row& other, double length) {
    for (std::size_t i = 0; i < count; ++i) part[i].lower_to(other.part[i], length);
  }
  [[nodiscard]] std::uint8_t improves(const Row& other, double length) const {
    unsigned any = 0;
    for (std::size_t i = 0; i < count; ++i) any |= part[i].improves(other.part[i], length);
    return static_cast<std::uint8_t>(any);
  }
};

inline void visit(const DistanceGroup& g, std::size_t position) {
  constexpr std::size_t width = DistanceGroup::lane_count;
  const std::uint32_t vertex = g.order[position];
  const std::uint32_t first = g.offsets[vertex];
  const std::uint32_t end = g.offsets[vertex + 1];
  Row here = Row::load(g.distances + vertex * width);
  for (std::uint32_t k = first; k < end; ++k) {
    here.lower_to(Row::load(g.distances + g.to[k] * width), g.lengths[k]);
  }
  here.store(g.distances + vertex * width);
  g.pending[position] = 0;
  // Without a branch: it would be unpredictable, and a misprediction costs more than the store.
  for (std::uint32_t k = first; k < end; ++k) {
    g.pending[g.place[g.to[k]]] |= here.improves(Row::load(g.distances + g.to[k] * width), g.lengths[k]);
  }
}

inline bool none_pending(const std::uint8_t* eight) {
  std::uint64_t word = 0;
  __builtin_memcpy(&word, eight, sizeof word);
  return word == 0;
}

/// Prefetches vertices: successive ones are far apart in memory, beyond the hardware prefetcher.
inline void prefetch(const DistanceGroup& g, std::size_t k, std::size_t count) {
  constexpr std::size_t ahead = 12;
  if (k + 2 * ahead >= count) return;
  __builtin_prefetch(g.offsets + g.order[k + 2 * ahead]);
  const std::uint32_t soon = g.order[k + ahead];
  for (std::size_t i = 0; i < Row::count; ++i) {
    __builtin_prefetch(g.distances + soon * DistanceGroup::lane_count + 8 * i);
  }
  __builtin_prefetch(g.place + soon);
  const std::uint32_t arc = g.offsets[soon];
  __builtin_prefetch(g.to + arc);
  __builtin_prefetch(g.lengths + arc);
}

std::size_t sweep(const DistanceGroup& g, std::size_t count, bool forward) {
  std::size_t visits = 0;
  if (forward) {
    for (std::size_t k = 0; k < count;) {
      if (k % 8 == 0 && none_pending(g.pending + k)) {
        k += 8;
        continue;
      }
      if (g.pending[k] != 0) {
        prefetch(g, k, count);
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

#pragma once

#include <cstdint>
#include <cstdlib>
#include <memory>

extern "C" {
#include "core/kernel/prepared_layout.h"
}

namespace semblante::testing {

/// A prepared face and its memory. No framework: other machines' tests and benchmarks use it too.
struct Prepared {
  struct Free {
    void operator()(void* memory) const { std::free(memory); }
  };
  std::unique_ptr<void, Free> memory;
  const semblante_prepared_face* face;

  /// By the machine's widest registers.
  explicit Prepared(const semblante_face& from, const semblante_rig* rig = nullptr)
      : memory(std::aligned_alloc(64, semblante_prepared_size(&from))),
        face(semblante_prepare_for(&from, rig, memory.get())) {}

  Prepared(const semblante_face& from, std::uint32_t group_size, const semblante_rig* rig = nullptr)
      : memory(std::aligned_alloc(64, semblante_prepared_size_by(group_size, &from))),
        face(semblante_prepare_by(group_size, &from, rig, memory.get())) {}
};

}  // namespace semblante::testing

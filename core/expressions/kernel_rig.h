#pragma once

#include <vector>

#include "core/expressions/library.h"
#include "core/kernel/semblante_kernel.h"
#include "core/types/rig.h"

namespace semblante {

/// Share of the viseme at an FP that an expression also moves (Eq. 5).
inline constexpr float default_viseme_share = 0.85F;

/// The kernel's data of one head, with the library's visemes and expressions in its units. Owns the arrays to which
/// view() points; can be copied and moved.
struct KernelRig {
  std::vector<float> visemes;      ///< 15 by 84 by 3, model units
  std::vector<float> expressions;  ///< 7 by 84 by 3, model units
  std::vector<semblante_companion> companions;
  semblante_rig fixed{};  ///< all members except the pointers and their counts

  /// Valid while this object exists and its arrays are not modified.
  [[nodiscard]] semblante_rig view() const;
};

KernelRig make_kernel_rig(const Rig& rig);

/// The influence table of a rig over `rest` (#V by 3) for semblante_deform. Points into the rig and rest.
semblante_face make_kernel_face(const Rig& rig, const float* rest);

}  // namespace semblante

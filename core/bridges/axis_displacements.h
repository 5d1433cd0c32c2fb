#pragma once

#include <array>

#include "core/kernel/semblante_kernel.h"

namespace semblante {

/// The displacement of each FAP's FP along the FAP's axis, or the rotation or growth of its part, by FAP number, FAP
/// units, on a head with the library's visemes and expressions. As in semblante_evaluate, Eq. 5 combines FAPs 1 and 2
/// with the default viseme share, and nonzero low-level FAPs override both. Entries 0..2 are 0.
std::array<double, SEMBLANTE_FAP_COUNT + 1> axis_displacements(const semblante_frame& frame);

}  // namespace semblante

#pragma once

#include <array>

#include "core/kernel/semblante_kernel.h"

namespace semblante {

/// By FAP number, FAP units: how far the FP of each FAP is along that FAP's axis, or by how much its part is turned or
/// grown, on a head that has the library's visemes and expressions. FAPs 1 and 2 are blended, joined by Eq. 5 with the
/// default share and replaced by low-level FAPs that are not zero, as semblante_evaluate does. Entries 0..2 are 0.
std::array<double, SEMBLANTE_FAP_COUNT + 1> axis_displacements(const semblante_frame& frame);

}  // namespace semblante

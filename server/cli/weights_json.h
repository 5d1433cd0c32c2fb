#pragma once

#include <iosfwd>

#include "core/types/rig.h"

namespace semblante {

/// {"points": ["2.1", ...], "vertices": [[["2.1", 0.25], ...], ...]}: the marked points in rising order, and W of Eq. 4
/// before the quotient of Eq. 7 (with `smooth` weights the shares themselves), one row per file vertex. Numbers are the
/// shortest that read back as the same double.
void write_weights_json(const Rig& rig, std::ostream& out);

}  // namespace semblante

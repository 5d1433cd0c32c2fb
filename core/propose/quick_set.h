#pragma once

#include "core/tables/mpeg4.h"

namespace semblante {

/// Twenty points that a person finds surely and that settle most of the rest: the middle, the left side, and one corner
/// on the right that settles how the head stands. README.md says how they were chosen. In the order to mark them.
inline constexpr auto& quick_set = mpeg4::quick_set;

}  // namespace semblante

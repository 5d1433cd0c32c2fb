#pragma once

#include "core/tables/mpeg4.h"

namespace semblante {

/// Twenty points that are easy to find and determine most of the others: the middle, the left side, and one corner on
/// the right that determines the pose of the head. In the order of marking. README.md explains the choice.
inline constexpr auto& quick_set = mpeg4::quick_set;

}  // namespace semblante

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/types/model.h"

namespace semblante {

/// The index of the material that a triangle of a primitive is painted with; nullopt: it keeps its own.
using PaintOf = std::function<std::optional<int>(const Primitive& primitive, std::uint32_t triangle)>;

/// The primitives of a model, divided where the paint changes, each with its material.
std::vector<Primitive> painted_primitives(const Model& model, const PaintOf& paint_of);

}  // namespace semblante

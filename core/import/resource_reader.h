#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "core/types/result.h"

namespace semblante::import {

/// Provides the other files of a model: buffers, images and material files. Returns the bytes of a path or URI that a
/// model file refers to (never a data: URI), at most `max_bytes`, or an error.
using ResourceReader = std::function<Result<std::vector<std::uint8_t>>(std::string_view uri, std::size_t max_bytes)>;

}  // namespace semblante::import

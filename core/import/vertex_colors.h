#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/types/model.h"

namespace semblante::import {

/// Colours of vertices as a file has them: three numbers each. A vertex without one has `no_color`.
using GivenColors = std::vector<glm::vec3>;
extern const glm::vec3 no_color;

/// Whether all three numbers are finite and no larger than 65535, the full light of files with 16 bits.
bool is_color(const glm::vec3& given);

enum class ColorNumbers : std::uint8_t { bytes, integers, reals };

/// The number that means full light. For bytes it is 255. Other files do not state it: reals are 0..1 in most files and
/// 0..255 in some, wider integers 0..65535 or 0..255. The largest number of the file tells which; reals of 0..1 may
/// exceed 1 slightly.
float full_light(std::span<const glm::vec3> given, ColorNumbers numbers);

enum class ColorSpace : std::uint8_t { srgb, linear };

/// Appends the colours. What is no colour (is_color()) becomes white; components out of range are clamped.
void append_colors(std::span<const glm::vec3> given, float full, ColorSpace space, std::vector<Color8>& to);

/// The warning about colours that were given but are none.
std::string warning_of_faulty_colors(std::size_t count);

/// Removes what no triangle shows: colours of primitives that are only white, and of vertices outside those that
/// has_colors. Returns whether it removed all of them because they are black: exporters without colours write zeros.
bool keep_seen_colors(Model& model);

}  // namespace semblante::import

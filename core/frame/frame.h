#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace semblante {

/// The length unit of a model's coordinates.
enum class LengthUnit : std::uint8_t { metre, decimetre, centimetre, millimetre, inch };
inline constexpr std::array<std::string_view, 5> length_unit_names = {"m", "dm", "cm", "mm", "in"};
std::string_view to_string(LengthUnit unit);
std::optional<LengthUnit> parse_length_unit(std::string_view name);
double metres_per(LengthUnit unit);

/// A direction along an axis of a model file.
enum class Direction : std::uint8_t { plus_x, minus_x, plus_y, minus_y, plus_z, minus_z };
inline constexpr std::array<std::string_view, 6> direction_names = {"+X", "-X", "+Y", "-Y", "+Z", "-Z"};
std::string_view to_string(Direction direction);
/// "+Y", "-Y" or "Y", in either case.
std::optional<Direction> parse_direction(std::string_view name);
glm::dvec3 to_vector(Direction direction);
/// 0 x, 1 y, 2 z.
int axis_of(Direction direction);
/// The direction along `axis` with the sign of `value`.
Direction direction_along(int axis, double value);

/// The axes of a head in its file: the directions of the top of the head and of the face's front. The default is
/// MPEG-4's axes.
struct Axes {
  Direction up = Direction::plus_y;
  Direction front = Direction::plus_z;

  bool operator==(const Axes&) const = default;
};

/// Whether up and front are along different axes, so that they are one of the 24 axis-aligned orientations.
bool are_valid(const Axes& axes);
/// All 24 axis-aligned orientations.
std::array<Axes, 24> all_axes();
/// MPEG-4 position = matrix * file position: a rotation that only permutes axes and changes signs, so that it is exact
/// for float32. `axes` must be valid.
glm::dmat3 to_mpeg4(const Axes& axes);

}  // namespace semblante

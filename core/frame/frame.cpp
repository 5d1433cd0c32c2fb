#include "core/frame/frame.h"

#include <algorithm>
#include <cassert>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace semblante {
namespace {

template <std::size_t size>
std::optional<std::size_t> find(const std::array<std::string_view, size>& names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace

std::string_view to_string(LengthUnit unit) { return length_unit_names[static_cast<std::size_t>(unit)]; }

std::optional<LengthUnit> parse_length_unit(std::string_view name) {
  const auto index = find(length_unit_names, name);
  return index ? std::optional(static_cast<LengthUnit>(*index)) : std::nullopt;
}

double metres_per(LengthUnit unit) {
  static constexpr std::array<double, length_unit_names.size()> metres = {1.0, 0.1, 0.01, 0.001, 0.0254};
  return metres[static_cast<std::size_t>(unit)];
}

std::string_view to_string(Direction direction) { return direction_names[static_cast<std::size_t>(direction)]; }

std::optional<Direction> parse_direction(std::string_view name) {
  std::string_view letter = name;
  const bool is_minus = name.starts_with('-');
  if (is_minus || name.starts_with('+')) letter.remove_prefix(1);
  if (letter.size() != 1) return std::nullopt;
  const auto axis = std::string_view("xyzXYZ").find(letter.front());
  if (axis == std::string_view::npos) return std::nullopt;
  return static_cast<Direction>(2 * (axis % 3) + (is_minus ? 1 : 0));
}

int axis_of(Direction direction) { return static_cast<int>(direction) / 2; }

glm::dvec3 to_vector(Direction direction) {
  glm::dvec3 vector(0.0);
  vector[axis_of(direction)] = static_cast<int>(direction) % 2 == 0 ? 1.0 : -1.0;
  return vector;
}

Direction direction_along(int axis, double value) { return static_cast<Direction>(2 * axis + (value < 0.0 ? 1 : 0)); }

bool are_valid(const Axes& axes) { return axis_of(axes.up) != axis_of(axes.front); }

std::array<Axes, 24> all_axes() {
  std::array<Axes, 24> all{};
  std::size_t count = 0;
  for (std::size_t up = 0; up < direction_names.size(); ++up) {
    for (std::size_t front = 0; front < direction_names.size(); ++front) {
      const Axes axes{static_cast<Direction>(up), static_cast<Direction>(front)};
      if (are_valid(axes)) all[count++] = axes;
    }
  }
  return all;
}

glm::dmat3 to_mpeg4(const Axes& axes) {
  assert(are_valid(axes));
  const glm::dvec3 up = to_vector(axes.up);
  const glm::dvec3 front = to_vector(axes.front);
  // Rows: the directions of the file that are mapped to +X (the face's left), +Y and +Z.
  return glm::transpose(glm::dmat3(glm::cross(up, front), up, front));
}

}  // namespace semblante

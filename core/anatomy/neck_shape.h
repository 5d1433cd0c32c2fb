#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/anatomy/head_landmarks.h"
#include "core/geometry/surface.h"
#include "core/types/neck_joints.h"

namespace semblante {

/// The shoulders begin no farther below the chin, in heights of the eyes above it.
inline constexpr double shoulders_within = 3.0;
/// Of the height from the chin to the eyes: as near to the border of the skin the neck is still.
inline constexpr double border_height = 0.04;
/// Above this height below the chin, in the same units, a section of the neck would cut the jaw.
inline constexpr double first_section = 0.15;
/// A border narrower than this share of the neck's width is a hole in the skin, not the end of the neck.
inline constexpr double spanning = 0.5;

/// A line where the skin ends below the jaw: of a cut neck, of a bust, at a collar.
struct SkinBorder {
  std::vector<SurfaceVertexId> vertices;
  double low = std::numeric_limits<double>::infinity(), high = -low;  ///< x
  double top = -std::numeric_limits<double>::infinity();              ///< y
};

/// `is_skin` by surface vertex.
std::vector<SkinBorder> borders_below_jaw(const Surface& surface, const std::vector<bool>& is_skin,
                                          const HeadLandmarks& marks);

struct NeckShape {
  glm::dvec3 axis{0.0};  ///< its middle at the narrowest section
  double radius = 0.0;
  double shoulders = 0.0;  ///< y where they begin, or of the border of a cut neck
  bool is_cut = false;
};

/// Measures the neck on horizontal sections of the skin. Empty without skin below the chin, or if the neck is cut so
/// near to the chin that the head turns as a whole.
std::optional<NeckShape> find_neck_shape(const Surface& surface, const std::vector<bool>& is_skin,
                                         const HeadLandmarks& marks, std::span<const SkinBorder> borders);

/// Lets the shoulders begin at the neck's joint if they were measured somewhere else: on a body without a waist below
/// its chin (narrow shoulders, hair in one piece with the skin), or where something else is narrow. A measured line
/// near the joint is kept, because skeletons place it anywhere between the nape and the collar bones.
void start_shoulders_at(const SkinJoint& joint, const HeadLandmarks& marks, NeckShape& neck);

}  // namespace semblante

#pragma once

#include <optional>
#include <span>

#include <glm/vec3.hpp>

#include "core/types/feature_points.h"
#include "core/types/rig.h"

namespace semblante {

struct HeadLandmarks {
  glm::dvec3 chin{0.0};
  double height = 0.0;  ///< from the chin to the eyes
  glm::dvec3 nape{0.0};
};

/// y of the eyes: of the pupils, else of the corners and edges of the lids, else of the eyeballs.
std::optional<double> eye_height(const FeaturePointSet& points, std::span<const Part> parts);

/// The chin: 2.1, else 2.10, else a place below a lip. `eyes` is the height of the eyes.
std::optional<glm::dvec3> chin_place(const FeaturePointSet& points, double eyes);

/// Empty without points that show the heights of eyes and chin, or if the chin is above the eyes.
std::optional<HeadLandmarks> find_head_landmarks(const FeaturePointSet& points, std::span<const Part> parts,
                                                 const glm::vec3& head_pivot);

/// y of the line from the chin to the nape, seen from the side, at this z.
double jaw_line(const HeadLandmarks& marks, double z);

/// Whether the place is above the line of the jaw, or hardly below it.
bool above_jaw(const HeadLandmarks& marks, const glm::dvec3& p);

}  // namespace semblante

#pragma once

#include <vector>

#include "core/doctor/finding.h"
#include "core/doctor/subject.h"

namespace semblante {

// Independent checks of the places of feature points; each returns its findings.

/// The orientation of the face: upside down, facing away, tilted, left and right exchanged.
std::vector<Finding> find_wrong_way_round(const Subject& head);

/// Points that violate the order defined by the standard: above, left of, in front of others.
std::vector<Finding> find_points_out_of_order(const Subject& head);

/// Points that violate the symmetry of the face.
std::vector<Finding> find_points_off_mirror(const Subject& head);

/// Points on the vertex of another point, on no surface, on a wrong part, or on the inside of a surface.
std::vector<Finding> find_points_on_wrong_surface(const Subject& head);

/// Points of lids that lie on the fold above (below) the edge of the lid.
std::vector<Finding> find_points_off_lid_edge(const Subject& head);

/// Points of lids that lie on an eye that is modelled in the skin.
std::vector<Finding> find_points_on_modelled_eyes(const Subject& head);

/// FAPUs without a value, or with an implausible one.
std::vector<Finding> find_unit_faults(const Subject& head);

/// Points that are not marked, with the features that need them.
std::vector<Finding> find_missing_points(const Subject& head);

}  // namespace semblante

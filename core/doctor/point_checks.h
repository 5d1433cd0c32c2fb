#pragma once

#include <vector>

#include "core/doctor/finding.h"
#include "core/doctor/subject.h"

namespace semblante {

// Checks of where feature points lie. Each gives its findings; none needs the others to have run.

/// The face as a whole: upside down, facing away, lying otherwise, left and right exchanged.
std::vector<Finding> find_wrong_way_round(const Subject& head);

/// Points that are not where the definitions of the standard put them among the others: above, left, in front.
std::vector<Finding> find_points_out_of_order(const Subject& head);

/// Points that are off the place which the mirror plane of the face gives them.
std::vector<Finding> find_points_off_mirror(const Subject& head);

/// Points on a vertex of another point, on no surface, on a part they do not belong to, on the inside of a surface.
std::vector<Finding> find_points_on_wrong_surface(const Subject& head);

/// Units that the points give no value, or none that a face has.
std::vector<Finding> find_unit_faults(const Subject& head);

/// Points that are not marked, with what does not work without them.
std::vector<Finding> find_missing_points(const Subject& head);

}  // namespace semblante

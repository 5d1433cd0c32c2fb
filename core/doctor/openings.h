#pragma once

#include <vector>

#include "core/doctor/finding.h"
#include "core/doctor/subject.h"
#include "core/tables/openings.h"

namespace semblante {

using mpeg4::lids_of;
using mpeg4::Opening;
using mpeg4::openings;

/// Rims joined across the slit: fused, or bridged by a membrane.
std::vector<Finding> find_joined_rims(const Subject& head);

/// A face that is not neutral: open mouth, closed eyes.
std::vector<Finding> find_rims_not_neutral(const Subject& head);

/// Points of one lip or lid that have weights at vertices of the other.
std::vector<Finding> find_leaks(const Subject& head);

/// Too few or too many vertices around mouth and eyes.
std::vector<Finding> find_wrong_density(const Subject& head);

}  // namespace semblante

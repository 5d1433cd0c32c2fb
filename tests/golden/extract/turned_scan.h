#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "core/extract/extract.h"

namespace semblante::testing {

/// The shape as a scan has it when the whole body moved: turned about the x axis by `degrees`, then shifted.
std::vector<glm::vec3> turned_scan(const std::vector<glm::vec3>& shape, double degrees, const glm::dvec3& shift);

/// Root of sum |got - expected|^2 / sum |expected|^2 over all feature points.
double relative_error(const std::vector<Displacement>& got, const std::vector<Displacement>& expected);

}  // namespace semblante::testing

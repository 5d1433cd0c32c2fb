#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include <glm/mat3x3.hpp>

#include "core/doctor/report.h"
#include "core/types/model.h"
#include "core/types/rig.h"
#include "server/store/records.h"

namespace semblante::jobs {

/// The minimum and maximum corner of the model's positions; both the origin for a model without positions.
std::pair<std::array<double, 3>, std::array<double, 3>> box_of(const Model& model);

std::vector<store::PartRecord> records_of(std::span<const Part> parts);

/// Row by row, the stored form of a turn.
store::Turn rows_of(const glm::dmat3& turn);

store::FindingCounts counts_of(const Report& report);

}  // namespace semblante::jobs

#pragma once

#include <span>
#include <vector>

#include <glm/mat3x3.hpp>

#include "core/doctor/report.h"
#include "core/types/model.h"
#include "core/types/rig.h"
#include "server/jobs/worker_protocol.h"

namespace semblante::jobs {

/// Format, counts and box of the model.
void describe(const Model& model, WorkerResult& result);

std::vector<store::PartRecord> records_of(std::span<const Part> parts);

/// Row by row, as the store keeps a turn.
store::Turn rows_of(const glm::dmat3& turn);

store::FindingCounts counts_of(const Report& report);

}  // namespace semblante::jobs

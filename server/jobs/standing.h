#pragma once

#include <span>

#include "core/geometry/surface.h"
#include "core/types/feature_points.h"
#include "core/types/marked_point.h"
#include "server/jobs/worker_protocol.h"

namespace semblante::jobs {

/// Import: guesses how the model stands, takes what the user says instead, and turns model and surface upright where
/// that is sure. Fills result.frame and result.turn, and warns where it turned or could not tell.
void stand_upright(Model& model, Surface& surface, const WorkerRequest& request, WorkerResult& result);

/// Parametrization: turns the model as its import did.
void stand_as_before(Model& model, const WorkerRequest& request);

/// ... and then examines the guess by the placed points. True when they show another way to stand, and the user has not
/// said how: model, surface and marked positions have been turned, and the points are to be placed again.
bool stand_by_points(Model& model, Surface& surface, std::span<MarkedPoint> marked, const FeaturePointSet& points,
                     const WorkerRequest& request, WorkerResult& result);

/// A position of the model as it stands now, told as it stood before `turn`.
glm::dvec3 turned_back(const glm::dvec3& position, const std::optional<store::Turn>& turn);

}  // namespace semblante::jobs

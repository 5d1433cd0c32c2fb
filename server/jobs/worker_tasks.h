#pragma once

#include "core/types/progress.h"
#include "server/jobs/worker_protocol.h"

namespace semblante::jobs {

// Each task translates its request into the stages of core/pipeline and what they give into its result.

/// Model bytes -> counts, parts, warnings, and the files `preview.glb`, `positions` (float32 x, y, z of each file
/// vertex, little-endian, MPEG-4 frame) and `report.json` (what the mesh alone shows) in the output directory.
Result<WorkerResult> run_import(const WorkerRequest& request, const Progress& progress);

/// Model bytes and feature points -> the files of the face package and `report.json` in the output directory.
Result<WorkerResult> run_parametrize(const WorkerRequest& request, const Progress& progress);

/// Model bytes and placed feature points -> proposals for the others.
Result<WorkerResult> run_propose(const WorkerRequest& request, const Progress& progress);

/// Neutral head, feature points and an expression of the same mesh -> a displacement set.
Result<WorkerResult> run_extract(const WorkerRequest& request, const Progress& progress);

}  // namespace semblante::jobs

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/geometry/surface.h"
#include "core/types/feature_points.h"
#include "core/types/rig.h"
#include "server/jobs/worker_protocol.h"

namespace semblante::jobs {

/// The bytes of a file the server named. Error: io.
Result<std::vector<std::uint8_t>> read_file(const std::string& path);

/// What a model file lacks or contradicts is a fault of the file. Elsewhere in a job the same codes are about the
/// feature points and fields of the request, and problem_from names them so.
Error about_the_file(Error error);

/// The request's source, as it lies in its file.
Result<Model> read_model(const WorkerRequest& request);

/// A model as its feature points say it stands, and the points on it.
struct MarkedModel {
  Surface surface;
  std::vector<std::optional<PartRole>> roles;
  FeaturePointSet points;
  std::vector<std::string> warnings;
  bool is_turned = false;
};

/// Turns the model as it stands and places the request's points on it; where they show that it stands otherwise, it is
/// turned once more, and `result` says so.
Result<MarkedModel> mark(Model& model, const WorkerRequest& request, WorkerResult& result);

}  // namespace semblante::jobs

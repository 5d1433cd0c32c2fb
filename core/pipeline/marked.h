#pragma once

#include <optional>
#include <vector>

#include "core/doctor/finding.h"
#include "core/geometry/insert_vertices.h"
#include "core/pipeline/standing.h"
#include "core/types/fapu.h"
#include "core/types/feature_points.h"
#include "core/types/rig.h"

namespace semblante {

/// Result of stage 3: the head with its feature points, rotated to the axes that were estimated from the points.
struct MarkedHead : StandingHead {
  FeaturePointSet points;
  std::vector<std::optional<PartRole>> roles_by_user;  ///< by PartId
  Fapu fapu_by_user;                                   ///< FAPUs set by the user
  std::vector<Finding> refused;                        ///< omitted points, see MarkRequest::leaves_out_refused
  /// Rotation from the axes of the StandingHead to those of this head; empty if the points did not change the axes.
  std::optional<glm::dmat3> turn;
  /// The vertices that `model` has for points between those of the file, after them.
  std::vector<InsertedVertex> inserted;

  /// Whether a vertex of `model` is one of its file.
  [[nodiscard]] bool is_of_file(VertexId vertex) const {
    return vertex.value() < model.positions.size() - inserted.size();
  }
};

struct MarkRequest {
  std::vector<MarkedPoint> points;                     ///< positions in the axes of the StandingHead
  std::vector<std::optional<PartRole>> roles_by_user;  ///< by PartId; where empty, the role is guessed
  /// If true, a point that cannot be placed is omitted and reported as a finding; if false, it is an error.
  bool leaves_out_refused = false;
  Fapu fapu_by_user = {};  ///< FAPUs set by the user; empty ones are measured
};

/// Places the points on the mesh and estimates the head's axes from them. If these differ from the axes of `head`, and
/// the user has not set the axes, rotates the head and places the points again. Then gives each point between vertices
/// a vertex of its own. Errors: those of place_feature_points; `cancelled`.
Result<MarkedHead> mark_head(StandingHead head, MarkRequest request, const Progress& progress = {});

}  // namespace semblante

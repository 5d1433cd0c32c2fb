#include "core/pipeline/rigged.h"

#include <utility>

#include "core/parametrize/parametrize.h"

namespace semblante {

Result<RiggedHead> rig_head(MarkedHead head, const RigRequest& request, const Progress& progress) {
  ParametrizeOptions options;
  options.roles_by_user = head.roles_by_user;
  options.fapu_by_user = head.fapu_by_user;
  options.weights = request.weights;
  options.metric = request.metric;
  options.progress = progress;
  auto rig = parametrize(head.model, head.surface, head.points, options);
  if (!rig) return rig.error();
  RiggedHead rigged{std::move(head), std::move(*rig)};
  rigged.warnings.rig = std::move(rigged.rig.warnings);
  rigged.rig.warnings.clear();
  rigged.rig.articulation = request.articulation;
  return rigged;
}

}  // namespace semblante

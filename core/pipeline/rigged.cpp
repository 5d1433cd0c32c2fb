#include "core/pipeline/rigged.h"

#include <utility>

#include "core/extract/own_articulation.h"
#include "core/parametrize/parametrize.h"

namespace semblante {
namespace {

Articulation articulation_of(const MarkedHead& head, const Fapu& fapu, std::optional<double> by_hand) {
  if (by_hand) return {*by_hand, "set by hand"};
  if (auto own = own_articulation(head.model, head.points, fapu)) return *std::move(own);
  return {usual_articulation, "the usual one: the head has no own shapes of open vowels (a, e, o)"};
}

}  // namespace

Result<RiggedHead> rig_head(MarkedHead head, const RigRequest& request, const Progress& progress) {
  ParametrizeOptions options;
  options.roles_by_user = head.roles_by_user;
  options.fapu_by_user = head.fapu_by_user;
  options.weights = request.weights;
  options.metric = request.metric;
  options.progress = progress;
  auto rig = parametrize(head.model, head.surface, head.points, options);
  if (!rig) return rig.error();
  RiggedHead rigged{std::move(head), std::move(*rig), {}};
  rigged.warnings.rig = std::move(rigged.rig.warnings);
  rigged.rig.warnings.clear();
  Articulation articulation = articulation_of(rigged, rigged.rig.fapu, request.articulation);
  rigged.rig.articulation = articulation.value;
  rigged.articulation_reason = std::move(articulation.reason);
  return rigged;
}

}  // namespace semblante

#include "core/pipeline/proposed.h"

#include "core/anatomy/part_roles.h"

namespace semblante {

Result<Proposals> propose_points(const MarkedHead& head) {
  const auto parts = describe_parts(head.model, head.surface, head.points, head.roles_by_user);
  return propose_feature_points(head.surface, parts, head.points, reference_heads(), head.model.neck_joints,
                                head.model.triangles);
}

}  // namespace semblante

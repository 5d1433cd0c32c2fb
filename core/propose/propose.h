#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/anatomy/reference_heads.h"
#include "core/geometry/surface.h"
#include "core/types/feature_points.h"
#include "core/types/neck_joints.h"
#include "core/types/result.h"
#include "core/types/rig.h"

namespace semblante {

/// The method of a proposal.
enum class ProposalMethod : std::uint8_t {
  mirror,      ///< the mirror image of the point on the other side
  proportion,  ///< the proportions of reference heads, deformed to the known points, then the nearest surface vertex
  shape,       ///< an extreme of the shape near that position (the highest, the most forward, an edge), or a joint
};
inline constexpr std::array<std::string_view, 3> proposal_method_names = {"mirror", "proportion", "shape"};

/// The confidence of a proposal, as in feature point files.
enum class Confidence : std::uint8_t { high, medium, low };
inline constexpr std::array<std::string_view, 3> confidence_names = {"high", "medium", "low"};

struct Proposal {
  FeaturePoint point;  ///< in the model's frame
  ProposalMethod method = ProposalMethod::proportion;
  Confidence confidence = Confidence::low;
  double expected_error =
      0.0;  ///< a radius in ES0: nine in ten proposals lie within theirs of a carefully placed point
  /// A further reason for doubt, as text; may be empty. A point of a lip or lid whose side is uncertain has a remark,
  /// and never `high` confidence.
  std::string remark;
};

struct NotProposed {
  FeaturePointId id;
  std::string reason;  ///< as text
};

struct Proposals {
  std::vector<Proposal> points;           ///< rising by id; none of the known ones
  std::vector<NotProposed> not_proposed;  ///< rising by id
};

/// With fewer marked points, those that the shape of the face shows by itself are looked for (found_points.h).
inline constexpr std::size_t least_known_points = 8;

/// Proposes the feature points that are missing in `known`. Known points are not changed. Deterministic, and
/// independent of the order of the points and of the model's unit. `references`: the proportions of other heads.
/// `joints`: of the model's skeleton; 7.1 is proposed at that of the head, if it can be this head's
/// (plausible_joints()). `triangles`: of the model. On a coarse mesh a point is proposed between vertices, as a
/// position without a vertex, where they show that the surface is nearer to it than any free vertex; without them
/// never.
///
/// Errors: `missing` if fewer than `least_known_points` are known and too few others are found by the shape of the
/// face, or if the points are too close together to determine the pose of the head.
Result<Proposals> propose_feature_points(const Surface& surface, std::span<const Part> parts,
                                         const FeaturePointSet& known,
                                         std::span<const ReferenceHead> references = reference_heads(),
                                         const NeckJoints& joints = {}, std::span<const Triangle> triangles = {});

}  // namespace semblante

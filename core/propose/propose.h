#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/surface.h"
#include "core/propose/reference_heads.h"
#include "core/types/feature_points.h"
#include "core/types/result.h"
#include "core/types/rig.h"

namespace semblante {

/// What a proposal rests on.
enum class ProposalMethod : std::uint8_t {
  mirror,      ///< the mirror image of the point on the other side
  proportion,  ///< the proportions of heads, bent to the known points, met with the surface
  shape,       ///< from there, a feature of the shape: the highest, the most forward, an edge
};
inline constexpr std::array<std::string_view, 3> proposal_method_names = {"mirror", "proportion", "shape"};

/// How sure a proposal is, in the words of feature point files.
enum class Confidence : std::uint8_t { high, medium, low };
inline constexpr std::array<std::string_view, 3> confidence_names = {"high", "medium", "low"};

struct Proposal {
  FeaturePoint point;  ///< in the model's frame
  ProposalMethod method = ProposalMethod::proportion;
  Confidence confidence = Confidence::low;
  double expected_error = 0.0;  ///< in ES0: what the distance to a carefully placed point is expected to be
  /// What else makes it unsure, in words; empty: nothing. A point of a lip or lid whose side the surface does not tell
  /// has a remark, and never `high` confidence.
  std::string remark;
};

struct NotProposed {
  FeaturePointId id;
  std::string reason;  ///< in words
};

struct Proposals {
  std::vector<Proposal> points;           ///< rising by id; none of the known ones
  std::vector<NotProposed> not_proposed;  ///< rising by id
};

/// Fewer known points than this say too little about a head.
inline constexpr std::size_t least_known_points = 8;

/// What is wrong with `known` before any model is looked at: `missing` when it has too few points, naming those of the
/// quick set that it lacks.
std::optional<Error> find_too_few_known(const FeaturePointSet& known);

/// Proposes the feature points that `known` lacks. Known points are taken as they are. Deterministic; neither the order
/// of the points nor the unit of the model counts. `references` is what is known of other heads.
///
/// Errors: `missing` for too few known points, or points too close together to tell how the head stands.
Result<Proposals> propose_feature_points(const Surface& surface, std::span<const Part> parts,
                                         const FeaturePointSet& known,
                                         std::span<const ReferenceHead> references = reference_heads());

}  // namespace semblante

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/types/feature_point_id.h"

namespace semblante {

/// Severity of a finding: with an error the face moves wrongly or not at all, with a warning it looks worse than
/// it could, a note is for information.
enum class Severity : std::uint8_t { error, warning, note };
inline constexpr std::array<std::string_view, 3> severity_names = {"error", "warning", "note"};

/// The kinds of findings. Each has a name for programs (finding_code_names), which never changes after its first
/// release.
enum class FindingCode : std::uint8_t {
  upside_down,
  facing_away,
  not_upright,
  left_right_swapped,
  no_points,
  missing_points,
  unit_not_positive,
  unit_implausible,
  unit_by_hand,
  point_refused,
  point_on_no_surface,
  point_on_wrong_part,
  skin_in_pieces,
  points_on_one_vertex,
  point_on_inside,
  point_on_other_rim,
  point_off_lid_edge,
  point_on_eye,
  point_out_of_order,
  point_off_mirror,
  lips_joined,
  lids_joined,
  lips_leak,
  lids_leak,
  mouth_open,
  eye_not_open,
  mouth_too_coarse,
  eye_too_coarse,
  face_too_dense,
  idle_part,
  second_skin,
  eye_cannot_turn,
  eye_welded,
  lids_in_eye,
  hole_near_points,
  inside_out,
  inconsistent_winding,
  open_seam,
  non_manifold_edges,
  duplicate_triangles,
  degenerate_triangles,
  unused_vertices,
  far_vertices,
  coarse_coordinates,
};
inline constexpr std::array finding_code_names = std::to_array<std::string_view>({
    "upside-down",
    "facing-away",
    "not-upright",
    "left-right-swapped",
    "no-points",
    "missing-points",
    "unit-not-positive",
    "unit-implausible",
    "unit-by-hand",
    "point-refused",
    "point-on-no-surface",
    "point-on-wrong-part",
    "skin-in-pieces",
    "points-on-one-vertex",
    "point-on-inside",
    "point-on-other-rim",
    "point-off-lid-edge",
    "point-on-eye",
    "point-out-of-order",
    "point-off-mirror",
    "lips-joined",
    "lids-joined",
    "lips-leak",
    "lids-leak",
    "mouth-open",
    "eye-not-open",
    "mouth-too-coarse",
    "eye-too-coarse",
    "face-too-dense",
    "idle-part",
    "second-skin",
    "eye-cannot-turn",
    "eye-welded",
    "lids-in-eye",
    "hole-near-points",
    "inside-out",
    "inconsistent-winding",
    "open-seam",
    "non-manifold-edges",
    "duplicate-triangles",
    "degenerate-triangles",
    "unused-vertices",
    "far-vertices",
    "coarse-coordinates",
});
constexpr std::string_view to_string(FindingCode code) { return finding_code_names[static_cast<std::size_t>(code)]; }

/// File vertices of a finding: the first few and the total number, because a bad model may have a million.
struct VertexSample {
  static constexpr std::size_t capacity = 32;

  std::vector<VertexId> vertices;  ///< the first `capacity` added ones; add() does not remove duplicates
  std::size_t count = 0;           ///< number of all added ones

  void add(VertexId vertex) {
    if (count++ < capacity) vertices.push_back(vertex);
  }
};

/// The place of a finding; members that do not apply are empty.
struct Place {
  std::optional<PartId> part;
  std::vector<FeaturePointId> points;  ///< in the order of the text
  VertexSample vertices;
  std::optional<glm::dvec3> position;  ///< where to look; model units, MPEG-4 frame
};

/// The place to which a point should be moved.
struct Move {
  FeaturePointId point;
  VertexId vertex;           ///< of the file
  glm::dvec3 position{0.0};  ///< of that vertex; model units, MPEG-4 frame
};

/// A measured value, and the threshold of the finding.
struct Measurement {
  std::string what;  ///< with its unit: "distance as a fraction of ES0"
  double value = 0.0;
  double threshold = 0.0;
};

/// One fault of a head, as text and as data.
struct Finding {
  FindingCode code{};
  Severity severity = Severity::warning;
  std::string words;   ///< the fault and its consequence, a sentence without a full stop
  std::string remedy;  ///< what to do about it, in the same form
  Place place;
  std::optional<Measurement> measured;
  std::optional<Move> move = std::nullopt;  ///< set if moving one point to this place is the remedy
};

}  // namespace semblante

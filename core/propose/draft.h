#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include <glm/vec3.hpp>

#include "core/anatomy/mirror_plane.h"
#include "core/anatomy/reference_heads.h"
#include "core/anatomy/rim_points.h"
#include "core/geometry/similarity.h"
#include "core/geometry/sphere_fit.h"
#include "core/geometry/surface.h"
#include "core/propose/face_surface.h"
#include "core/propose/found_points.h"
#include "core/propose/proportion_guess.h"
#include "core/propose/propose.h"
#include "core/propose/relations.h"
#include "core/propose/rim_choice.h"
#include "core/types/feature_points.h"
#include "core/types/rig.h"

namespace semblante {

// Points by their number, that of FeaturePointId.
FeaturePointId id_of(std::size_t id);
std::size_t index_of(std::string_view name);

/// The head for which points are proposed. All that is referred to must outlive its users.
struct HeadToMark {
  const Surface& surface;
  std::span<const Part> parts;
  std::span<const Triangle> triangles;  ///< of file vertices, may be empty
  const FeaturePointSet& known;
  std::span<const FoundPoint> found = {};  ///< those of `known` that nobody marked: proposals as well
};

/// A position, with the surface vertex there, if any.
struct Spot {
  glm::dvec3 place{0.0};
  std::optional<std::uint32_t> vertex;
};

/// The proposals of a head as they are made: where each point is expected, where those that are settled (known, or
/// proposed so far) lie, and which vertices are still free. Places are in an upright frame of unit ES0, vertices are
/// surface vertices.
class Draft {
 public:
  /// `frame` maps positions of the surface to the upright frame.
  Draft(const HeadToMark& head, const Similarity& frame, std::span<const ReferenceHead> references);
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;

  [[nodiscard]] const HeadToMark& head() const { return head_; }
  [[nodiscard]] const Similarity& frame() const { return frame_; }
  [[nodiscard]] const FaceSurface& face() const { return face_; }
  [[nodiscard]] const MirrorPlane& plane() const { return plane_; }
  [[nodiscard]] const Places& settled() const { return settled_; }
  /// The known points and those proposed so far.
  [[nodiscard]] std::vector<SurfacePoint> present_points() const;

  // Where a point is expected.

  /// Whether the other heads have the point. The next four need that.
  [[nodiscard]] bool is_expected(std::size_t id) const { return guesses_[id].has_value(); }
  /// Whether it is expected at the mirror image of a known point.
  [[nodiscard]] bool has_image(std::size_t id) const { return images_[id].has_value(); }
  [[nodiscard]] const glm::dvec3& expected(std::size_t id) const;
  [[nodiscard]] double error(std::size_t id) const { return guesses_[id]->error; }
  /// Whether a vertex and the known point whose mirror image it is to be both lie on lids that are pieces of their own.
  [[nodiscard]] bool is_on_lid_of_image(std::size_t id, std::uint32_t vertex) const;
  /// `mirror` or `proportion`.
  [[nodiscard]] ProposalMethod method(std::size_t id) const;

  // Places of the surface.

  [[nodiscard]] bool is_free(std::uint32_t vertex) const { return !taken_.contains(vertex); }
  /// Whether a place of the surface may be the point expected at `place`.
  [[nodiscard]] static bool is_near(const glm::dvec3& of_surface, const glm::dvec3& place, double error);
  /// Whether there is any surface near a place: with vertices that have a point, or are of the other lip or lid.
  [[nodiscard]] bool has_surface_near(PartRole role, const glm::dvec3& place, double error) const;
  /// Considers only vertices without a point: the parametrization needs a vertex of its own for each point. Prefers
  /// those that keep the order of the points on a face. Empty if the role has none left.
  std::optional<RimVertex> nearest_vertex(std::size_t id, PartRole role, const glm::dvec3& place, double error);
  /// The free vertex of a lip or lid at the mirror image of a known point, unless the surface shows that it is on the
  /// other side: the known point tells the side where the mesh connects both. Keeps the order of the points on a
  /// face.
  std::optional<RimVertex> vertex_at_image(std::size_t id, PartRole role);
  /// On a coarse mesh: a place between vertices that is clearly nearer to the expected one than `nearest`, the vertex
  /// to choose otherwise. It keeps the order of the points on a face and does not come near another point. Not
  /// for lips and lids, because only vertices have a side.
  [[nodiscard]] std::optional<glm::dvec3> place_between(std::size_t id, PartRole role, const glm::dvec3& place,
                                                        double error, const std::optional<RimVertex>& nearest) const;

  // The proposals.

  [[nodiscard]] bool is_proposed(std::size_t id) const { return find_proposal(id) != nullptr; }
  /// The vertex of a proposed point; empty if the point is known, not proposed or a bare position.
  [[nodiscard]] std::optional<std::uint32_t> proposed_vertex(std::size_t id) const;
  [[nodiscard]] ProposalMethod proposed_method(std::size_t id) const { return find_proposal(id)->method; }
  void settle(std::size_t id, const Spot& spot, ProposalMethod method, double error, std::string doubt = {});
  /// Withdraws a proposal, to settle the point elsewhere or to refuse it; its vertex is free again.
  void withdraw(std::size_t id);
  void refuse(std::size_t id, std::string reason);
  /// The result, in order. The draft is empty afterwards.
  [[nodiscard]] Proposals take();

 private:
  void find_mirror_plane();
  void guess(std::span<const ReferenceHead> references);
  [[nodiscard]] double noise_of(std::size_t known) const;
  void propose_found();
  [[nodiscard]] const Proposal* find_proposal(std::size_t id) const;
  [[nodiscard]] glm::dvec3 mirror_image(std::size_t id) const;
  [[nodiscard]] std::optional<PartId> piece_of_partner(std::size_t id) const;
  [[nodiscard]] bool is_on_piece_of_image(PartId partner, std::uint32_t vertex) const;
  [[nodiscard]] bool are_apart(const mpeg4::Opening& lids) const;

  HeadToMark head_;
  Similarity frame_;
  FaceSurface face_;
  PartId piece_of_face_;  ///< of the surface
  MirrorPlane plane_;
  std::array<std::optional<Sphere>, 2> eyeballs_;  ///< of the left and the right eye
  Places settled_;
  std::unordered_set<std::uint32_t> taken_;  ///< vertices with a point
  std::vector<SurfacePoint> anchors_;        ///< the known points, and those proposed on open skin
  RimChoice rims_{face_, anchors_};
  Places images_;  ///< mirror images of known points whose partner is not known
  std::array<std::optional<Guess>, feature_point_count> guesses_;
  Proposals proposals_;
};

}  // namespace semblante

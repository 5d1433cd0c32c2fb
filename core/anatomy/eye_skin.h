#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "core/geometry/front_grid.h"
#include "core/geometry/sphere_fit.h"
#include "core/geometry/surface.h"
#include "core/types/model.h"

namespace semblante {

/// The places of the four points of an eye's lids: `left` and `right` are the corners, as the face has them.
struct LidPlaces {
  glm::dvec3 upper, lower, left, right;
};

/// The opening between the points of the lids, seen from the front: two parabolas from corner to corner.
class EyeOpening {
 public:
  /// `beyond`: how far the eye may go on beyond the parabolas, as a share of the opening's height.
  EyeOpening(const LidPlaces& p, double beyond) : p_(p), beyond_(beyond * (p.upper.y - p.lower.y)) {}
  [[nodiscard]] double width() const;
  [[nodiscard]] glm::dvec3 middle() const;
  [[nodiscard]] bool is_sane() const;
  [[nodiscard]] bool contains(const glm::dvec3& at) const;
  /// 2/3 of width times height, as of every parabola.
  [[nodiscard]] double area() const;

 private:
  [[nodiscard]] double arc(double x) const { return (x - p_.right.x) * (p_.left.x - x); }
  [[nodiscard]] double base(double x) const;
  [[nodiscard]] double height(const glm::dvec3& middle, double x) const;
  LidPlaces p_;
  double beyond_;
};

/// The skin about an eye that is modelled in it, and the patch of it that is the eye: smooth, on a ball if it is round,
/// and ending in a groove where the lids step forward.
class EyeSkin {
 public:
  /// The triangles of `part` near the opening; the eye does not go on beyond it. `places` are those of the vertices of
  /// `surface`, in the frame of the opening; `triangles` are of file vertices; `width` is that of the eye. Keeps
  /// references to `places` and `opening`.
  EyeSkin(const Surface& surface, std::span<const glm::dvec3> places, std::span<const Triangle> triangles, PartId part,
          const EyeOpening& opening, double width);

  /// Marks the triangles of the eye, from the one in the middle of the opening on. Whether they fill it.
  bool find_eye();

  /// Marks the triangles of a ball that goes on behind the lids and is welded to them at some vertices, as by a
  /// converter that merges near vertices. Hidden triangles are marked too. Returns whether there is a ball that fills
  /// the opening.
  bool find_welded_eye();

  /// Marks the triangles that go on smoothly from the one that is seen at `at`. Whether they end.
  bool grow_from(const glm::dvec3& at);

  /// Marks what those triangles surround, too, such as the rim of a carved iris.
  void add_holes();

  /// The ball that the marked triangles lie on; of a flat eye a great one.
  [[nodiscard]] const std::optional<Sphere>& fitted() const { return ball_; }

  /// What is seen straight from the front.
  struct View : FrontGrid {
    std::vector<double> z;     ///< by knot; minus infinity where nothing is seen
    std::vector<bool> is_eye;  ///< by knot

    [[nodiscard]] glm::dvec3 place(int column, int row) const {
      return {origin.x + column * step, origin.y + row * step, z[at(column, row)]};
    }
    /// The knot nearest to a place within the grid.
    [[nodiscard]] std::size_t knot(const glm::dvec3& place) const { return at(column_at(place.x), row_at(place.y)); }
  };
  [[nodiscard]] View view() const;

  /// Empty if the eye is too flat to roll on.
  [[nodiscard]] std::optional<Sphere> ball() const;

  /// Whether a vertex is surrounded by the ball: a corner marked there is none.
  [[nodiscard]] bool is_on_ball(SurfaceVertexId v) const;

  /// The vertices all of whose triangles belong to the eye; rising.
  [[nodiscard]] std::vector<SurfaceVertexId> inner_vertices() const;

  /// Those, and the vertices that are surrounded by the ball; rising.
  [[nodiscard]] std::vector<SurfaceVertexId> vertices_on_ball() const;

  /// Where the eye that is seen at one x ends, above and below.
  struct Seen {
    glm::dvec3 upper, lower;
    [[nodiscard]] double height() const { return upper.y - lower.y; }
  };
  [[nodiscard]] std::optional<Seen> seen_at(double x) const;

  /// The least and the greatest x of the eye.
  [[nodiscard]] std::pair<double, double> across() const;

  /// The vertex nearest to `to` among those that are not held.
  [[nodiscard]] std::optional<SurfaceVertexId> nearest_but(std::span<const SurfaceVertexId> held,
                                                           const glm::dvec3& to) const;

 private:
  using Corners = std::array<SurfaceVertexId, 3>;
  struct Face {
    Corners corners;
    glm::dvec3 normal, middle;
    double area;
    std::vector<std::size_t> beside;
  };

  [[nodiscard]] const glm::dvec3& place(SurfaceVertexId v) const { return places_[v.value()]; }
  /// The foremost triangle at a place, seen from the front.
  [[nodiscard]] std::optional<std::size_t> front_face(const glm::dvec3& at) const;
  /// The ball through the corners of the patch; empty while it is small.
  [[nodiscard]] std::optional<Sphere> ball_of_patch() const;
  /// The share of the patch's outline at which `ends(face of the patch, face beside it)`.
  template <class Ends>
  [[nodiscard]] double share_of_outline(const Ends& ends) const;
  /// The share of the patch's outline at which the surface does not go on smoothly.
  [[nodiscard]] double grooved_share() const;
  /// The share of the patch's outline at which the surface does not go on smoothly, or goes on behind other skin.
  [[nodiscard]] double hidden_share() const;
  [[nodiscard]] static bool bends_forward(const Face& from, const Face& to);
  /// Whether the eye goes on from one triangle to the next.
  [[nodiscard]] bool continues(const Face& from, const Face& to) const;
  [[nodiscard]] bool is_smooth(const Face& from, const Face& to) const;
  [[nodiscard]] bool is_on_ball(const Face& face) const;

  std::span<const glm::dvec3> places_;
  const EyeOpening& opening_;
  double width_;
  std::vector<Face> faces_;
  std::vector<std::size_t> patch_;  ///< the places in `faces_` of the triangles of the eye
  std::vector<bool> of_eye_;
  std::optional<Sphere> ball_;
  bool is_welded_ = false;  ///< what lies beyond the opening is not the eye that is seen
};

}  // namespace semblante

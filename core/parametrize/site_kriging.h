#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "core/anatomy/opening_margins.h"
#include "core/geometry/surface.h"
#include "core/parametrize/non_negative_kriging.h"
#include "core/parametrize/point_distances.h"

namespace semblante {

/// A vertex that moves like the points on it, or on an edge like a mix of points.
struct KrigingSite {
  SurfaceVertexId vertex;
  glm::dvec3 position{0.0};
  std::vector<std::pair<FeaturePointId, double>> shares;  ///< positive, sum 1
  std::optional<std::size_t> slot;                        ///< in PointDistances, of a point here
  /// Without a search from here: its distances to all slots, and those slots that give the best bounds for near places.
  std::vector<double> distances;
  std::vector<std::size_t> landmarks;
};

/// One site for each vertex with points on it, in the order of the points.
std::vector<KrigingSite> point_sites(const PointDistances& distances);
/// The margins on this part that have no point on them.
std::vector<KrigingSite> edge_sites(const Surface& surface, const PointDistances& distances,
                                    std::span<const MarginSite> margins);

/// Covariance of two places r units apart: exp(-(r / length)^power); positive definite for powers up to 2.
struct KrigingKernel {
  double length;
  double power;
  /// Subtracted from every covariance to a target, so that far sites get exactly zero weight.
  double least;

  [[nodiscard]] double at(double distance) const;
  /// The distance from which on the covariance is zero.
  [[nodiscard]] double reach() const;
};

/// The values of a kernel within its reach, by cubic interpolation, which is quicker than a power and an exponential.
class KernelTable {
 public:
  explicit KernelTable(const KrigingKernel& kernel);
  /// Within 1e-8 of the kernel; `distance` less than its reach.
  [[nodiscard]] double at(double distance) const;

 private:
  /// The value t of the way from a node to the next one: of degree three, with the kernel's values and slopes at both.
  struct Cubic {
    double constant, linear, quadratic, cubic;
    [[nodiscard]] double at(double t) const { return constant + t * (linear + t * (quadratic + t * cubic)); }
  };
  KrigingKernel kernel_;
  double steps_per_unit_;
  std::vector<Cubic> from_node_;
};

/// Kriging without negative weights (non_negative_kriging.h) from sites of one part to its vertices.
class SiteKriging {
 public:
  /// `unit`: the length that distances are measured in, model units. Keeps references to the first two.
  SiteKriging(const Surface& surface, const PointDistances& distances, std::vector<KrigingSite> sites, double unit,
              KrigingKernel kernel);

  struct Term {
    const KrigingSite* site;
    double weight;
  };
  /// The weights of sites at a member of the part: positive, and continuous over the surface. Exactly (site, 1) at a
  /// site's own vertex. Valid until the next call.
  std::span<const Term> at(std::size_t member);

  [[nodiscard]] std::span<const KrigingSite> sites() const { return sites_; }

 private:
  struct NearSite {
    glm::dvec3 position;  ///< of the site: most are looked at no further
    std::size_t site;
  };
  using NearSites = std::vector<NearSite>;
  /// Those of `sites` that are within reach of the box of the members from `first` on, at most `count`.
  [[nodiscard]] NearSites within_reach(const NearSites& sites, std::size_t first, std::size_t count) const;
  /// The sites within reach of a block of members: by far most are out, and out of reach of the blocks around it.
  const NearSites& near_block(std::size_t block);

  const Surface& surface_;
  const PointDistances& distances_;
  std::vector<KrigingSite> sites_;
  double unit_;
  KrigingKernel kernel_;
  KernelTable table_;
  double reach_;  ///< model units
  NonNegativeKriging kriging_;
  NearSites all_;
  std::vector<std::optional<NearSites>> near_run_, near_block_;  ///< by run of blocks, and by block: those asked for
  std::vector<std::size_t> candidates_;
  std::vector<double> to_target_;
  std::vector<Term> terms_;
};

}  // namespace semblante

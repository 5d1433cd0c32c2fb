#include "core/parametrize/fitted_weights.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/anatomy/smooth_step.h"
#include "core/geometry/nearest_point.h"
#include "core/parametrize/greatest_weights.h"
#include "core/parametrize/weight_row.h"

namespace semblante {
namespace {

// Chosen by leave-one-out errors of two real heads (tests/bench/weights); both have a wide optimum.
constexpr double smooth_ridge = 0.1;
constexpr double ridge_length = 0.3;  ///< in units
/// The edges of lips and lids hold the skin beside them up to this distance, in units.
constexpr double held = 0.1;
/// Coordinate descent ends when no weight changes by more.
constexpr double least_descent = 1e-5;
constexpr int most_descents = 60;
/// Members whose equations are set up together: bounds the memory.
constexpr std::size_t fit_block = 1024;

/// A symmetric matrix over the points of the part.
using Gram = std::vector<double>;

/// One shape: its points' displacements divided by the root of its size.
struct KnownShape {
  const Example* source;
  double scale = 0.0;               ///< zero: no point moves
  std::vector<glm::dvec3> points;   ///< #F
  std::vector<glm::dvec3> members;  ///< of the block, scaled
};

void add_shape(Gram& gram, const KnownShape& known, double sign) {
  const std::size_t count = known.points.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) {
      gram[i * count + j] += sign * glm::dot(known.points[i], known.points[j]);
    }
  }
}

/// The row of one vertex: minimizes w'(gram)w - 2 wanted'w + sum of ridges (w - smooth)^2 over w >= 0.
struct RowProblem {
  std::span<const double> wanted, smooth, ridges;

  /// `w`: where to start, and the solution. `slope`: scratch.
  void solve(const Gram& gram, std::span<double> w, std::vector<double>& slope) const {
    const std::size_t count = w.size();
    slope.resize(count);
    for (std::size_t i = 0; i < count; ++i) slope[i] = wanted[i] + ridges[i] * (smooth[i] - w[i]);
    for (std::size_t j = 0; j < count; ++j) {
      if (w[j] == 0.0) continue;
      for (std::size_t i = 0; i < count; ++i) slope[i] -= gram[j * count + i] * w[j];
    }
    for (int sweep = 0; sweep < most_descents; ++sweep) {
      bool is_done = true;
      for (std::size_t k = 0; k < count; ++k) {
        const double step = std::max(-w[k], slope[k] / (gram[k * count + k] + ridges[k]));
        if (std::abs(step) < least_descent) continue;
        is_done = false;
        w[k] += step;
        for (std::size_t i = 0; i < count; ++i) slope[i] -= gram[k * count + i] * step;
        slope[k] -= ridges[k] * step;
      }
      if (is_done) return;
    }
  }
};

class PartFit {
 public:
  PartFit(const PointDistances& distances, const WeightTable<double>& smooth, std::span<const double> freedom,
          std::span<const Example> shapes, double unit)
      : distances_(distances),
        smooth_(smooth),
        freedom_(freedom),
        length_(ridge_length * unit),
        count_(distances.points.size()),
        all_(count_ * count_, 0.0),
        smooth_row_(count_),
        ridges_(count_) {
    slot_of_.fill(0);
    for (std::size_t f = 0; f < count_; ++f) slot_of_[distances.points[f].id.value()] = f;
    for (const Example& shape : shapes) {
      known_shapes_.push_back(known_shape(shape));
      add_shape(all_, known_shapes_.back(), 1.0);
      result_.errors.push_back({shape.name, 0.0, 0.0, 0.0});
    }
    for (const KnownShape& known : known_shapes_) add_shape(without_.emplace_back(all_), known, -1.0);
  }

  /// Sets up the members of a block, at most fit_block.
  void read_block(std::size_t first, std::size_t last) {
    first_ = first;
    wanted_.assign((last - first) * count_, 0.0);
    for (KnownShape& known : known_shapes_) {
      known.members.assign(last - first, glm::dvec3(0.0));
      if (known.scale == 0.0) continue;
      const std::vector<std::uint32_t>& of = known.source->vertices;
      const auto from = std::lower_bound(of.begin(), of.end(), first);
      for (auto at = static_cast<std::size_t>(from - of.begin()); at < of.size() && of[at] < last; ++at) {
        const glm::dvec3 moved = glm::dvec3(known.source->displacements[at]) * known.scale;
        known.members[of[at] - first] = moved;
        double* const wanted = &wanted_[(of[at] - first) * count_];
        for (std::size_t f = 0; f < count_; ++f) wanted[f] += glm::dot(moved, known.points[f]);
      }
    }
  }

  /// The next member of the block; all in order.
  void fit(std::size_t member, bool is_sampled) {
    std::fill(smooth_row_.begin(), smooth_row_.end(), 0.0);
    for (std::size_t k = 0; k < smooth_.points_of(member).size(); ++k) {
      smooth_row_[slot_of_[smooth_.points_of(member)[k].value()]] = smooth_.weights_of(member)[k];
    }
    const std::span<const double> from = distances_.of_member(member, from_points_);
    for (std::size_t f = 0; f < count_; ++f) {
      const double away = from[f] / length_;
      ridges_[f] = smooth_ridge * (1.0 + away * away);
    }
    const std::span<const double> wanted = std::span(wanted_).subspan((member - first_) * count_, count_);
    fitted_ = smooth_row_;
    RowProblem{wanted, smooth_row_, ridges_}.solve(all_, fitted_, slope_);
    push_row(result_.rows, row_of(fitted_, freedom_[member]));
    if (!is_sampled) return;
    for (std::size_t s = 0; s < known_shapes_.size(); ++s) leave_out(s, member, wanted);
  }

  FittedWeights take() { return std::move(result_); }

 private:
  [[nodiscard]] KnownShape known_shape(const Example& shape) const {
    KnownShape known{&shape, 0.0, {}, {}};
    double size = 0.0;
    for (const SurfacePoint& point : distances_.points) {
      const auto at = std::lower_bound(distances_.members.begin(), distances_.members.end(), point.vertex);
      const auto member = static_cast<std::uint32_t>(at - distances_.members.begin());
      known.points.emplace_back(shape.at(member));
      size += glm::dot(known.points.back(), known.points.back());
    }
    if (size > 0.0) known.scale = 1.0 / std::sqrt(size);
    for (glm::dvec3& moved : known.points) moved *= known.scale;
    return known;
  }

  WeightRow row_of(std::span<const double> weights, double freedom) {
    WeightRow row;
    double sum = 0.0;
    for (std::size_t f = 0; f < count_; ++f) {
      const double w = smooth_row_[f] + freedom * (weights[f] - smooth_row_[f]);
      row.at(distances_.points[f].id.value()) = w;
      sum += w;
    }
    if (sum > 1.0) row.for_each([&](std::size_t, double& w) { w /= sum; });
    keep_greatest(row);
    return row;
  }

  /// Predicts the member in one shape by a fit to the others.
  void leave_out(std::size_t s, std::size_t member, std::span<const double> wanted) {
    const KnownShape& known = known_shapes_[s];
    if (known.scale == 0.0) return;
    const glm::dvec3& truth = known.members[member - first_];
    others_.assign(wanted.begin(), wanted.end());
    for (std::size_t f = 0; f < count_; ++f) others_[f] -= glm::dot(truth, known.points[f]);
    left_out_ = fitted_;
    RowProblem{others_, smooth_row_, ridges_}.solve(without_[s], left_out_, slope_);
    const WeightRow row = row_of(left_out_, freedom_[member]);
    glm::dvec3 wrong = -truth;
    glm::dvec3 smooth_wrong = -truth;
    for (std::size_t f = 0; f < count_; ++f) {
      wrong += row[distances_.points[f].id.value()] * known.points[f];
      smooth_wrong += smooth_row_[f] * known.points[f];
    }
    const double to_model = 1.0 / (known.scale * known.scale);
    result_.errors[s].moved += to_model * glm::dot(truth, truth);
    result_.errors[s].wrong += to_model * glm::dot(wrong, wrong);
    result_.errors[s].smooth_wrong += to_model * glm::dot(smooth_wrong, smooth_wrong);
  }

  const PointDistances& distances_;
  const WeightTable<double>& smooth_;
  std::span<const double> freedom_;
  double length_;
  std::size_t count_;
  std::array<std::size_t, feature_point_count> slot_of_{};
  std::vector<KnownShape> known_shapes_;
  Gram all_;                   ///< of all shapes
  std::vector<Gram> without_;  ///< entry s: of all shapes except shape s
  std::size_t first_ = 0;
  std::vector<double> wanted_;  ///< of the block, by member
  std::vector<double> from_points_, smooth_row_, ridges_, fitted_, others_, left_out_, slope_;
  FittedWeights result_;
};

}  // namespace

std::vector<double> freedom_of_members(const Surface& surface, const PointDistances& distances,
                                       std::span<const MarginSite> margins, double unit, const ModelledEyes& modelled) {
  std::vector<double> freedom(distances.members.size(), 1.0);
  std::vector<glm::dvec3> edges;
  for (const MarginSite& margin : margins) {
    if (margin.is_edge) edges.push_back(surface.positions[margin.vertex.value()]);
  }
  for (std::size_t m = 0; m < freedom.size(); ++m) {
    if (is_held(modelled, distances.members[m])) freedom[m] = 0.0;
  }
  if (edges.empty()) return freedom;
  NearestPoint nearest(edges);
  for (std::size_t m = 0; m < freedom.size(); ++m) {
    if (freedom[m] == 0.0) continue;
    const glm::dvec3& p = surface.positions[distances.members[m].value()];
    if (nearest.has_within(p, held * unit)) freedom[m] = smooth_step(0.0, held, nearest.nearest(p).distance / unit);
  }
  return freedom;
}

Result<FittedWeights> fit_part_weights(const PointDistances& distances, const WeightTable<double>& smooth,
                                       std::span<const double> freedom, std::span<const Example> shapes, double unit,
                                       std::size_t sample_every, const Progress& progress) {
  assert(smooth.row_count() == distances.members.size() && freedom.size() == smooth.row_count() && unit > 0.0 &&
         sample_every > 0);
  PartFit fit(distances, smooth, freedom, shapes, unit);
  const std::size_t members = distances.members.size();
  for (std::size_t first = 0; first < members; first += fit_block) {
    if (progress && !progress(static_cast<double>(first) / static_cast<double>(members), "fit to own shapes"))
      return Error{ErrorCode::cancelled, "", "stopped on request"};
    const std::size_t last = std::min(first + fit_block, members);
    fit.read_block(first, last);
    for (std::size_t m = first; m < last; ++m) fit.fit(m, m % sample_every == 0);
  }
  return fit.take();
}

}  // namespace semblante

#include "core/parametrize/surface_weights.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/parametrize/fitted_weights.h"
#include "core/parametrize/influence_regions.h"
#include "core/parametrize/own_shapes.h"
#include "core/parametrize/point_distances.h"
#include "core/parametrize/smooth_weights.h"
#include "core/parametrize/weights.h"

namespace semblante {
namespace {

/// Predictions of one vertex in one shape, for the leave-one-out errors: about a second at most.
constexpr std::size_t most_left_out = 100'000;

/// Adds the errors of a part to those of the others.
void add_errors(const std::vector<ShapeError>& more, std::vector<ShapeError>& sums) {
  if (sums.empty()) {
    sums = more;
    return;
  }
  for (std::size_t s = 0; s < sums.size(); ++s) {
    sums[s].moved += more[s].moved;
    sums[s].wrong += more[s].wrong;
    sums[s].smooth_wrong += more[s].smooth_wrong;
  }
}

}  // namespace

Result<SurfaceWeights> surface_weights(const Surface& surface, std::span<const SurfacePoint> points,
                                       const Progress& progress, const WeightOptions& options) {
  std::vector<std::size_t> points_on(surface.part_count(), 0);
  std::size_t work = 0;  // searches weighted by the size of their part
  for (const SurfacePoint& point : points) {
    const PartId part = surface.part_of[point.vertex.value()];
    ++points_on[part.value()];
    work += surface.members_of(part).size();
  }

  std::vector<WeightTable<double>> of_part(surface.part_count());
  const Surface& graph = options.distance_graph != nullptr ? *options.distance_graph : surface;
  std::vector<MarginSite> margins;
  if (are_shares(options.method)) margins = margin_sites(surface, points, options.modelled_eyes, options.parts);
  SurfaceWeights result;
  const std::size_t sample_every =
      std::max(std::size_t{1}, surface.vertex_count() * options.shapes.size() / most_left_out);
  std::size_t done = 0;
  const auto go_on = [&](std::size_t more, std::string_view stage) {
    done += more;
    return !progress || progress(work == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(work), stage);
  };
  for (std::uint32_t p = 0; p < surface.part_count(); ++p) {
    if (points_on[p] == 0) continue;
    const PartId part(p);
    const std::size_t share = points_on[p] * surface.members_of(part).size();
    if (!go_on(0, "distances")) return Error{ErrorCode::cancelled, "", "stopped on request"};
    const PointDistances distances = measure_distances(graph, part, points);
    if (are_shares(options.method)) {
      if (!go_on(share / 2, "weights")) return Error{ErrorCode::cancelled, "", "stopped on request"};
      of_part[p] = smooth_part_weights(surface, distances, options.eye_separation, margins, trained_weight_prior(),
                                       options.modelled_eyes);
      if (options.method == WeightMethod::fitted && options.fitted_parts[p]) {
        const std::size_t fitted_then = done + (share - share / 2);
        const double from = work == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(work);
        const double to = work == 0 ? 1.0 : static_cast<double>(fitted_then) / static_cast<double>(work);
        const double unit = weight_unit(distances, options.eye_separation);
        auto fitted = fit_part_weights(
            distances, of_part[p], freedom_of_members(surface, distances, margins, unit, options.modelled_eyes),
            shapes_of_members(options.shapes, distances.members), unit, sample_every, part_of(progress, from, to));
        if (!fitted) return fitted.error();
        of_part[p] = std::move(fitted->rows);
        add_errors(fitted->errors, result.errors);
      }
      done += share - share / 2;
      continue;
    }
    if (!go_on(share / 2, "regions of influence")) return Error{ErrorCode::cancelled, "", "stopped on request"};
    const std::vector<SlotSet> regions = influence_regions(surface, distances);
    if (!go_on(share / 4, "weights")) return Error{ErrorCode::cancelled, "", "stopped on request"};
    of_part[p] = part_weights(surface, distances, regions);
    done += share - share / 2 - share / 4;
  }

  // Parts list their members in rising order, so iterating over the vertices uses each part's rows in order.
  WeightTable<double>& table = result.rows;
  table.offsets.reserve(surface.vertex_count() + 1);
  std::vector<std::size_t> next(surface.part_count(), 0);
  for (const PartId part : surface.part_of) {
    const WeightTable<double>& rows = of_part[part.value()];
    if (rows.row_count() > 0) {
      const std::size_t row = next[part.value()]++;
      const auto ids = rows.points_of(row);
      const auto weights = rows.weights_of(row);
      table.points.insert(table.points.end(), ids.begin(), ids.end());
      table.weights.insert(table.weights.end(), weights.begin(), weights.end());
    }
    table.end_row();
  }
  return result;
}

}  // namespace semblante

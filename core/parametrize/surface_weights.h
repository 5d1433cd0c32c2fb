#pragma once

#include <span>
#include <vector>

#include "core/anatomy/modelled_eye.h"
#include "core/anatomy/point_lookup.h"
#include "core/geometry/surface.h"
#include "core/parametrize/weight_method.h"
#include "core/types/example.h"
#include "core/types/progress.h"
#include "core/types/result.h"
#include "core/types/weight_fit.h"
#include "core/types/weight_table.h"

namespace semblante {

struct WeightOptions {
  WeightMethod method = WeightMethod::paper;
  /// ES0 in model units, for `smooth`; 0: unknown.
  double eye_separation = 0.0;
  /// The graph for distances, if not `surface` itself: the same vertices and parts with other edges.
  const Surface* distance_graph = nullptr;
  /// For `fitted`: the head's own shapes by surface vertex (own_shapes.h), not empty; and the parts that are fitted, by
  /// PartId. The others keep smooth weights.
  std::span<const Example> shapes = {};
  std::vector<bool> fitted_parts = {};
  // For `smooth` and `fitted`.
  ModelledEyes modelled_eyes = {};
  std::span<const Part> parts = {};  ///< by PartId
};

struct SurfaceWeights {
  WeightTable<double> rows;        ///< #S
  std::vector<ShapeError> errors;  ///< of `fitted`, by shape
};

/// Weights of every surface vertex (#S rows), part by part: distances, then with `paper` regions, neighbours and W of
/// Eq. 4, with `smooth` the shares of smooth_weights.h, with `fitted` those of fitted_weights.h. Fails only with
/// `cancelled`. `progress` may be empty.
Result<SurfaceWeights> surface_weights(const Surface& surface, std::span<const SurfacePoint> points,
                                       const Progress& progress = {}, const WeightOptions& options = {});

/// Gives each file vertex the row of its surface vertex: #V rows.
template <class W>
WeightTable<W> rows_of_file_vertices(const Surface& surface, const WeightTable<W>& rows) {
  WeightTable<W> table;
  table.offsets.reserve(surface.surface_of.size() + 1);
  for (const SurfaceVertexId vertex : surface.surface_of) {
    const auto points = rows.points_of(vertex.value());
    const auto weights = rows.weights_of(vertex.value());
    table.points.insert(table.points.end(), points.begin(), points.end());
    table.weights.insert(table.weights.end(), weights.begin(), weights.end());
    table.end_row();
  }
  return table;
}

}  // namespace semblante

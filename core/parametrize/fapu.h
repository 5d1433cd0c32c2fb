#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/types/fapu.h"
#include "core/types/feature_points.h"
#include "core/types/result.h"

namespace semblante {

/// FAPUs of a neutral face, in model units, already divided by 1024:
///
///     IRISD  mean of 3.1.y - 3.3.y (left eye) and 3.2.y - 3.4.y (right); one eye alone is enough, and
///            of two the open one alone if the other is closed. Of a slanted eye whose corners are marked the
///            height of the opening at one x (slanted_opening.h of core/anatomy): what lids have to close
///     ES     3.5.x - 3.6.x
///     ENS    3.5.y - 9.15.y
///     MNS    9.15.y - 2.2.y
///     MW     8.3.x - 8.4.x; if one of them is not marked, 2.4.x - 2.5.x times `outer_per_inner_width`
///
/// A unit whose points are missing, or whose points are swapped so that it would not be positive, stays empty.
///
/// Closed eyes: if the lids are less than `closed_lids` of ES0 apart (and all corners of the lids are marked), the
/// centre between the corners of each eye replaces its pupil, which the lids hide, and IRISD is `iris_share` of ES0.
/// These values have the origin `closed_eyes`.
///
/// Units in `by_user` replace the computed ones; their origin is `user`.
Fapu compute_fapu(const FeaturePointSet& points, const Fapu& by_user = {});

/// Distance of the lids below which the eyes are closed, as a fraction of ES0: a third of the diameter of an iris.
inline constexpr double closed_lids = 0.06;
/// Mean diameter of the iris of human adults (11.8 mm) as a fraction of ES0 (63 mm).
inline constexpr double iris_share = 0.187;

/// Width of the mouth between the outer corners of the lips as a multiple of that between the inner ones: the mean of
/// 14 marked heads, which have 1.05 to 1.15.
inline constexpr double outer_per_inner_width = 1.09;

/// Lengths of units given by hand: model units, NOT divided by 1024 (ES0, not ES), by name ("ES").
using FapuLengths = std::map<std::string, double>;

/// Checks lengths given by hand and converts them. Errors: `invalid_argument` for an unknown name; `out_of_range` for a
/// length that is not finite, not positive or absurd (outside 1e-6 to 1e6).
Result<Fapu> fapu_from_lengths(const FapuLengths& lengths);

/// One sentence for each unit that `compute_fapu` leaves empty: its name, why, and what does not work without it.
/// `fapu` may have been completed by hand; only units still empty are explained.
std::vector<std::string> explain_missing_fapu(const Fapu& fapu, const FeaturePointSet& points);

}  // namespace semblante

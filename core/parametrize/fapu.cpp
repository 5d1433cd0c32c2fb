#include "core/parametrize/fapu.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/anatomy/point_lookup.h"
#include "core/anatomy/slanted_opening.h"
#include "core/tables/mpeg4.h"
#include "core/tables/openings.h"

namespace semblante {
namespace {

/// In the order of FapuUnit, as mpeg4::fapus: what stands still without the unit.
constexpr std::array<std::string_view, fapu_unit_count> needed_for = {
    "FAPs of eyelids and pupils (19-22, 29, 30)",
    "FAPs of eyeball thrust and sideways brows (27, 28, 37-40)",
    "FAPs of brows, cheeks, nose and ears (31-36, 41, 42, 61-68)",
    "FAPs of mouth, jaw and tongue, vertical and forward (3-5, 8-14, 16-18, 44, 46, 51, 52, 55-60)",
    "FAPs of mouth, jaw and tongue, sideways (6, 7, 15, 43, 45, 53, 54)",
};

/// The unit is the mean of those of its measures whose points are marked.
std::span<const mpeg4::Measure> measures_of(std::size_t unit) {
  const mpeg4::FapuInfo& info = mpeg4::fapus[unit];
  return std::span(info.measures).first(info.measure_count);
}

std::string_view id_of(std::uint8_t point) { return mpeg4::feature_points[point].id; }

/// A FAP value of 1024 moves a point by the whole distance (mpeg4/fapu.json, "divisor").
constexpr double divisor = 1024.0;

/// The corners of the eye whose upper lid the point is on; empty for other points, or if one is not marked.
std::optional<std::array<glm::dvec3, 2>> corners_of_lid(std::string_view upper, const FeaturePointSet& points) {
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const mpeg4::Opening& lids = mpeg4::lids_of(eye);
    if (lids.upper.front() != upper) continue;
    const FeaturePoint* const a = find_point(points, lids.corners[0]);
    const FeaturePoint* const b = find_point(points, lids.corners[1]);
    if (a != nullptr && b != nullptr) return std::array{glm::dvec3(a->position), glm::dvec3(b->position)};
  }
  return std::nullopt;
}

std::optional<double> measure(const mpeg4::Measure& wanted, const FeaturePointSet& points) {
  const FeaturePoint* const from = find_point(points, id_of(wanted.from));
  const FeaturePoint* const to = find_point(points, id_of(wanted.to));
  if (from == nullptr || to == nullptr) return std::nullopt;
  if (const auto corners = corners_of_lid(id_of(wanted.to), points))
    return opening_height(glm::dvec3(to->position), glm::dvec3(from->position), (*corners)[0], (*corners)[1]);
  return static_cast<double>(to->position[wanted.axis]) - static_cast<double>(from->position[wanted.axis]);
}

/// Empty when no measure of this FAPU has all its points marked.
std::optional<double> mean_length(std::size_t unit, const FeaturePointSet& points) {
  double sum = 0.0;
  int count = 0;
  for (const mpeg4::Measure& one : measures_of(unit)) {
    const std::optional<double> length = measure(one, points);
    if (!length) continue;
    sum += *length;
    ++count;
  }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

constexpr std::size_t index_of(FapuUnit unit) { return static_cast<std::size_t>(unit); }

/// The distance of the lids of one eye, if the other eye is closed.
std::optional<double> lid_distance_of_open_eye(const FeaturePointSet& points) {
  const std::optional<double> separation = mean_length(index_of(FapuUnit::es), points);
  if (!separation) return std::nullopt;
  std::vector<double> open;
  std::size_t closed = 0;
  for (const mpeg4::Measure& one : measures_of(index_of(FapuUnit::irisd))) {
    const std::optional<double> length = measure(one, points);
    if (!length) continue;
    if (*length >= closed_lids * *separation)
      open.push_back(*length);
    else if (*length > -closed_lids * *separation)
      ++closed;
  }
  return open.size() == 1 && closed == 1 ? std::optional(open.front()) : std::nullopt;
}

std::optional<double> compute_unit(std::size_t unit, const FeaturePointSet& points) {
  const std::optional<double> length = mean_length(unit, points);
  return length && *length > 0.0 ? std::optional(*length / divisor) : std::nullopt;
}

/// MW0 of a head with an unmarked outer corner of the lips, from the inner ones: on a damaged or coarse mesh there may
/// be no vertex for it, and without MW no point of the mouth that also moves sideways would move.
std::optional<double> mouth_width_of_inner_corners(const FeaturePointSet& points) {
  if (mean_length(index_of(FapuUnit::mw), points)) return std::nullopt;
  const FeaturePoint* const left = find_point(points, "2.4");
  const FeaturePoint* const right = find_point(points, "2.5");
  if (left == nullptr || right == nullptr) return std::nullopt;
  const double inner = static_cast<double>(left->position.x) - static_cast<double>(right->position.x);
  return inner > 0.0 ? std::optional(outer_per_inner_width * inner) : std::nullopt;
}

/// The points with each pupil at the centre between the corners of its lids, if the lids are closed; else empty.
std::optional<FeaturePointSet> with_centres_of_closed_eyes(const FeaturePointSet& points) {
  const std::array<const FeaturePoint*, 4> corners = {find_point(points, "3.7"), find_point(points, "3.11"),
                                                      find_point(points, "3.12"), find_point(points, "3.8")};
  if (std::find(corners.begin(), corners.end(), nullptr) != corners.end()) return std::nullopt;
  const auto centre = [](const FeaturePoint& a, const FeaturePoint& b) { return 0.5F * (a.position + b.position); };
  const glm::vec3 left = centre(*corners[0], *corners[1]);
  const glm::vec3 right = centre(*corners[2], *corners[3]);
  const double separation = static_cast<double>(left.x) - static_cast<double>(right.x);
  const std::optional<double> gap = mean_length(index_of(FapuUnit::irisd), points);
  // A lower lid clearly above the upper one is a fault of marking: the doctor reports it.
  if (!gap || !(separation > 0.0) || std::abs(*gap) >= closed_lids * separation) return std::nullopt;
  FeaturePointSet visible = points;
  for (const auto& [name, place] : {std::pair("3.5", left), std::pair("3.6", right)}) {
    const FeaturePointId id = *parse_feature_point(name);
    const auto at = std::lower_bound(visible.begin(), visible.end(), id,
                                     [](const FeaturePoint& p, FeaturePointId wanted) { return p.id < wanted; });
    if (at != visible.end() && at->id == id)
      at->position = place;
    else
      visible.insert(at, {id, std::nullopt, place});
  }
  return visible;
}

}  // namespace

Fapu compute_fapu(const FeaturePointSet& points, const Fapu& by_user) {
  Fapu fapu;
  const std::optional<FeaturePointSet> visible = with_centres_of_closed_eyes(points);
  for (std::size_t unit = 0; unit < fapu_unit_count; ++unit) {
    fapu.value[unit] = compute_unit(unit, visible ? *visible : points);
    if (visible && (unit == index_of(FapuUnit::es) || unit == index_of(FapuUnit::ens)))
      fapu.origin[unit] = FapuOrigin::closed_eyes;
  }
  if (visible && fapu[FapuUnit::es]) {
    fapu.value[index_of(FapuUnit::irisd)] = iris_share * *fapu[FapuUnit::es];
    fapu.origin[index_of(FapuUnit::irisd)] = FapuOrigin::closed_eyes;
  }
  if (const std::optional<double> open = lid_distance_of_open_eye(points); open && !visible)
    fapu.value[index_of(FapuUnit::irisd)] = *open / divisor;
  if (const std::optional<double> width = mouth_width_of_inner_corners(points))
    fapu.value[index_of(FapuUnit::mw)] = *width / divisor;
  for (std::size_t unit = 0; unit < fapu_unit_count; ++unit) {
    if (!by_user.value[unit]) continue;
    fapu.value[unit] = by_user.value[unit];
    fapu.origin[unit] = FapuOrigin::user;
  }
  return fapu;
}

Result<Fapu> fapu_from_lengths(const FapuLengths& lengths) {
  Fapu fapu;
  for (const auto& [name, length] : lengths) {
    const auto* const found = std::find(fapu_unit_names.begin(), fapu_unit_names.end(), name);
    if (found == fapu_unit_names.end())
      return Error{ErrorCode::invalid_argument, "",
                   "this is not a unit that depends on the face: IRISD, ES, ENS, MNS or MW"};
    constexpr double least = 1e-6;
    constexpr double greatest = 1e6;
    if (!(length >= least && length <= greatest))
      return Error{ErrorCode::out_of_range, "", name + " must be a length in model units, from 1e-6 to 1e6"};
    const auto unit = static_cast<std::size_t>(found - fapu_unit_names.begin());
    fapu.value[unit] = length / divisor;
    fapu.origin[unit] = FapuOrigin::user;
  }
  return fapu;
}

std::vector<std::string> explain_missing_fapu(const Fapu& fapu, const FeaturePointSet& points) {
  std::vector<std::string> sentences;
  for (std::size_t unit = 0; unit < fapu_unit_count; ++unit) {
    if (fapu.value[unit]) continue;
    const mpeg4::Measure& first = measures_of(unit).front();
    std::string sentence(fapu_unit_names[unit]);
    sentence += " cannot be measured: ";
    if (mean_length(unit, points)) {
      sentence += std::string(id_of(first.to)) + (first.axis == 0 ? " is not to the left of " : " is not above ");
      sentence += id_of(first.from);
    } else {
      std::string missing;
      for (const std::string_view id : {id_of(first.to), id_of(first.from)}) {
        if (find_point(points, id) != nullptr) continue;
        if (!missing.empty()) missing += " and ";
        missing += id;
      }
      sentence += missing + (missing.find(' ') == std::string::npos ? " is not marked" : " are not marked");
    }
    sentence += "; without it these do nothing: ";
    sentence += needed_for[unit];
    sentences.push_back(std::move(sentence));
  }
  return sentences;
}

}  // namespace semblante

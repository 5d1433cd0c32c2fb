#include "core/parametrize/fapu.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/anatomy/point_lookup.h"

namespace semblante {
namespace {

/// A difference of one coordinate of two points: the length of a unit on the neutral face, times 1024.
struct Span {
  std::string_view from, to;
  int axis;
};

constexpr int x = 0;
constexpr int y = 1;

struct Definition {
  std::array<Span, 2> spans;  ///< the unit is their mean; the second is empty for units with one span
  std::string_view needed_for;
};

/// In the order of FapuUnit.
constexpr std::array<Definition, fapu_unit_count> definitions = {{
    {{{{"3.1", "3.3", y}, {"3.2", "3.4", y}}}, "FAPs of eyelids and pupils (19-22, 29, 30)"},
    {{{{"3.5", "3.6", x}, {}}}, "FAPs of eyeball thrust and sideways brows (27, 28, 37-40)"},
    {{{{"3.5", "9.15", y}, {}}}, "FAPs of brows, cheeks, nose and ears (31-36, 41, 42, 61-68)"},
    {{{{"9.15", "2.2", y}, {}}},
     "FAPs of mouth, jaw and tongue, vertical and forward (3-5, 8-14, 16-18, 44, "
     "46, 51, 52, 55-60)"},
    {{{{"8.3", "8.4", x}, {}}}, "FAPs of mouth, jaw and tongue, sideways (6, 7, 15, 43, 45, 53, 54)"},
}};

/// A FAP value of 1024 moves a point by the whole distance (mpeg4/fapu.json, "divisor").
constexpr double divisor = 1024.0;

std::optional<double> measure(const Span& span, const FeaturePointSet& points) {
  if (span.from.empty()) return std::nullopt;
  const FeaturePoint* const from = find_point(points, span.from);
  const FeaturePoint* const to = find_point(points, span.to);
  if (from == nullptr || to == nullptr) return std::nullopt;
  return static_cast<double>(from->position[span.axis]) - static_cast<double>(to->position[span.axis]);
}

constexpr std::size_t index_of(FapuUnit unit) { return static_cast<std::size_t>(unit); }

std::optional<double> compute_unit(const Definition& definition, const FeaturePointSet& points) {
  double sum = 0.0;
  int count = 0;
  for (const Span& span : definition.spans) {
    const std::optional<double> length = measure(span, points);
    if (!length) continue;
    sum += *length;
    ++count;
  }
  return count > 0 && sum > 0.0 ? std::optional(sum / count / divisor) : std::nullopt;
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
  double sum = 0.0;
  int count = 0;
  for (const Span& span : definitions[index_of(FapuUnit::irisd)].spans) {
    const std::optional<double> gap = measure(span, points);
    if (!gap) continue;
    sum += *gap;
    ++count;
  }
  // A lower lid clearly above the upper one is a fault of marking: the doctor reports it.
  if (count == 0 || !(separation > 0.0) || std::abs(sum / count) >= closed_lids * separation) return std::nullopt;
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
    fapu.value[unit] = compute_unit(definitions[unit], visible ? *visible : points);
    if (visible && (unit == index_of(FapuUnit::es) || unit == index_of(FapuUnit::ens)))
      fapu.origin[unit] = FapuOrigin::closed_eyes;
  }
  if (visible && fapu[FapuUnit::es]) {
    fapu.value[index_of(FapuUnit::irisd)] = iris_share * *fapu[FapuUnit::es];
    fapu.origin[index_of(FapuUnit::irisd)] = FapuOrigin::closed_eyes;
  }
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
    const Definition& definition = definitions[unit];
    const Span& first = definition.spans[0];
    std::string sentence(fapu_unit_names[unit]);
    sentence += " cannot be measured: ";
    if (measure(first, points) || measure(definition.spans[1], points)) {
      sentence += std::string(first.from) + (first.axis == x ? " is not to the left of " : " is not above ");
      sentence += first.to;
    } else {
      std::string missing;
      for (const std::string_view id : {first.from, first.to}) {
        if (find_point(points, id) != nullptr) continue;
        if (!missing.empty()) missing += " and ";
        missing += id;
      }
      sentence += missing + (missing.find(' ') == std::string::npos ? " is not marked" : " are not marked");
    }
    sentence += "; without it these do nothing: ";
    sentence += definition.needed_for;
    sentences.push_back(std::move(sentence));
  }
  return sentences;
}

}  // namespace semblante

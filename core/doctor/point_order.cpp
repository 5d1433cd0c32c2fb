#include "core/anatomy/point_order.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/anatomy/point_lookup.h"
#include "core/doctor/mirror_offsets.h"
#include "core/doctor/point_checks.h"
#include "core/doctor/words.h"

namespace semblante {
namespace {

constexpr std::array<std::string_view, 3> relation_words = {"to the left of ", "above ", "in front of "};

/// A relation that two points violate; `by`: by how much along the axis, as a fraction of ES0.
struct Broken {
  FeaturePointId more, less;
  FaceAxis axis;
  double by;

  [[nodiscard]] bool concerns(FeaturePointId id) const { return id == more || id == less; }
};

std::vector<Broken> broken_relations(const FaceAxes& face) {
  std::vector<Broken> broken;
  for (const PointOrder& relation : point_orders()) {
    const auto& more = face.place(relation.more);
    const auto& less = face.place(relation.less);
    if (!more || !less) continue;
    const double by =
        ((*less)[static_cast<int>(relation.axis)] - (*more)[static_cast<int>(relation.axis)]) / *face.eye_separation;
    if (by > point_order_tolerance) broken.push_back({relation.more, relation.less, relation.axis, by});
  }
  return broken;
}

/// The point with the most violated relations: a misplaced point violates several, its neighbours one each. Among
/// equals the one with the larger asymmetry.
FeaturePointId most_to_blame(const std::vector<Broken>& broken, const std::array<double, feature_point_count>& off) {
  std::array<std::pair<std::size_t, double>, feature_point_count> blame{};
  for (const Broken& b : broken) {
    for (const FeaturePointId id : {b.more, b.less}) blame[id.value()] = {blame[id.value()].first + 1, off[id.value()]};
  }
  const auto* const most = std::max_element(blame.begin(), blame.end());
  return FeaturePointId(static_cast<std::uint8_t>(most - blame.begin()));
}

}  // namespace

std::vector<Finding> find_points_out_of_order(const Subject& head) {
  std::vector<Finding> findings;
  if (!head.frame.eye_separation) return findings;
  std::vector<Broken> broken = broken_relations(head.frame);
  const auto off_mirror = mirror_offsets(head.frame);
  while (!broken.empty()) {
    const FeaturePointId point = most_to_blame(broken, off_mirror);
    const auto rest =
        std::stable_partition(broken.begin(), broken.end(), [&](const Broken& b) { return b.concerns(point); });
    const auto worst =
        *std::max_element(broken.begin(), rest, [](const Broken& a, const Broken& b) { return a.by < b.by; });
    Finding finding;
    finding.code = FindingCode::point_out_of_order;
    finding.severity = Severity::warning;
    finding.place.points.push_back(point);
    for (auto b = broken.begin(); b != rest; ++b) finding.place.points.push_back(b->more == point ? b->less : b->more);
    if (const FeaturePoint* const at = find_point(head.rig.points, to_string(point))) {
      finding.place.position = glm::dvec3(at->position);
      if (at->vertex) finding.place.vertices.add(*at->vertex);
    }
    finding.words = to_string(worst.more) + " is not " +
                    std::string(relation_words[static_cast<std::size_t>(worst.axis)]) + to_string(worst.less) +
                    " as on every face, but " + percent(worst.by) + " of the eye distance beyond it";
    finding.remedy = "check " + to_string(point) + " first, then " +
                     list_of(std::span(finding.place.points).subspan(1)) +
                     "; the point may be marked at the place of another point";
    finding.measured = {"distance on the wrong side as a fraction of ES0", worst.by, point_order_tolerance};
    findings.push_back(std::move(finding));
    broken.erase(broken.begin(), rest);
  }
  return findings;
}

}  // namespace semblante

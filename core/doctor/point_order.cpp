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

/// Two millimetres on a human face: smaller differences are within the precision of marking, and touching lips are
/// closer.
constexpr double tolerance = 0.03;

enum Axis : int { x, y, z };
constexpr std::array<std::string_view, 3> relation_words = {"to the left of ", "above ", "in front of "};

/// `more` is after `less` along the axis on every face, by the definitions of the points in
/// core/tables/data/feature-points.json. Points that may be level are not compared.
struct Relation {
  Axis axis;
  std::string_view more, less;
};

constexpr auto relations = std::to_array<Relation>({
    // top to bottom
    {y, "11.4", "11.1"},
    {y, "11.1", "4.1"},
    {y, "11.1", "4.2"},
    {y, "11.3", "4.3"},
    {y, "11.2", "4.4"},
    {y, "4.1", "3.11"},
    {y, "4.2", "3.8"},
    {y, "4.3", "3.13"},
    {y, "4.4", "3.14"},
    {y, "4.5", "3.7"},
    {y, "4.6", "3.12"},
    {y, "3.13", "3.1"},
    {y, "3.14", "3.2"},
    {y, "3.1", "3.3"},
    {y, "3.2", "3.4"},
    {y, "3.3", "3.9"},
    {y, "3.4", "3.10"},
    {y, "3.9", "9.15"},
    {y, "3.10", "9.15"},
    {y, "3.5", "9.15"},
    {y, "3.6", "9.15"},
    {y, "9.7", "9.13"},
    {y, "9.6", "9.14"},
    {y, "9.12", "9.3"},
    {y, "9.3", "8.1"},
    {y, "9.15", "8.1"},
    {y, "9.1", "8.3"},
    {y, "9.2", "8.4"},
    {y, "8.1", "2.2"},
    {y, "8.10", "2.2"},
    {y, "8.9", "2.2"},
    {y, "8.5", "2.6"},
    {y, "8.6", "2.7"},
    {y, "2.2", "2.3"},
    {y, "2.6", "2.8"},
    {y, "2.7", "2.9"},
    {y, "2.3", "8.2"},
    {y, "2.8", "8.7"},
    {y, "2.9", "8.8"},
    {y, "8.2", "2.10"},
    {y, "8.7", "2.11"},
    {y, "8.8", "2.12"},
    {y, "2.10", "2.1"},
    {y, "5.3", "8.3"},
    {y, "5.4", "8.4"},
    {y, "5.3", "5.1"},
    {y, "5.4", "5.2"},
    {y, "10.1", "10.3"},
    {y, "10.2", "10.4"},
    {y, "10.3", "10.5"},
    {y, "10.4", "10.6"},
    {y, "10.9", "10.7"},
    {y, "10.10", "10.8"},
    {y, "9.8", "9.10"},
    {y, "9.11", "9.9"},
    // the face's left to right
    {x, "3.7", "3.5"},
    {x, "3.5", "3.11"},
    {x, "3.7", "3.1"},
    {x, "3.1", "3.11"},
    {x, "3.7", "3.3"},
    {x, "3.3", "3.11"},
    {x, "3.7", "3.9"},
    {x, "3.9", "3.11"},
    {x, "3.7", "3.13"},
    {x, "3.13", "3.11"},
    {x, "3.11", "3.8"},
    {x, "3.8", "3.6"},
    {x, "3.6", "3.12"},
    {x, "3.8", "3.2"},
    {x, "3.2", "3.12"},
    {x, "3.8", "3.4"},
    {x, "3.4", "3.12"},
    {x, "3.8", "3.10"},
    {x, "3.10", "3.12"},
    {x, "3.8", "3.14"},
    {x, "3.14", "3.12"},
    {x, "4.5", "4.3"},
    {x, "4.3", "4.1"},
    {x, "4.1", "4.2"},
    {x, "4.2", "4.4"},
    {x, "4.4", "4.6"},
    {x, "8.3", "2.4"},
    {x, "2.4", "2.6"},
    {x, "2.6", "2.2"},
    {x, "2.2", "2.7"},
    {x, "2.7", "2.5"},
    {x, "2.5", "8.4"},
    {x, "2.4", "2.8"},
    {x, "2.8", "2.3"},
    {x, "2.3", "2.9"},
    {x, "2.9", "2.5"},
    {x, "8.3", "8.5"},
    {x, "8.5", "8.10"},
    {x, "8.10", "8.1"},
    {x, "8.1", "8.9"},
    {x, "8.9", "8.6"},
    {x, "8.6", "8.4"},
    {x, "8.3", "8.7"},
    {x, "8.7", "8.2"},
    {x, "8.2", "8.8"},
    {x, "8.8", "8.4"},
    {x, "9.1", "9.3"},
    {x, "9.3", "9.2"},
    {x, "9.13", "9.12"},
    {x, "9.12", "9.14"},
    {x, "2.13", "2.11"},
    {x, "2.11", "2.10"},
    {x, "2.10", "2.12"},
    {x, "2.12", "2.14"},
    {x, "10.3", "3.7"},
    {x, "3.12", "10.4"},
    {x, "11.3", "11.1"},
    {x, "11.1", "11.2"},
    {x, "5.3", "3.11"},
    {x, "3.8", "5.4"},
    // front to back
    {z, "9.3", "9.15"},
    {z, "9.3", "9.1"},
    {z, "9.3", "9.2"},
    {z, "9.3", "3.11"},
    {z, "9.3", "3.8"},
    {z, "2.10", "2.13"},
    {z, "2.10", "2.14"},
    {z, "8.1", "8.3"},
    {z, "8.1", "8.4"},
    {z, "2.2", "2.4"},
    {z, "2.2", "2.5"},
    {z, "2.3", "2.4"},
    {z, "2.3", "2.5"},
    {z, "9.3", "7.1"},
    {z, "7.1", "11.6"},
    {z, "9.3", "10.3"},
    {z, "9.3", "10.4"},
    {z, "10.3", "11.6"},
    {z, "10.4", "11.6"},
    {z, "3.7", "10.9"},
    {z, "3.12", "10.10"},
});

/// A relation that two points violate; `by`: by how much along the axis, as a fraction of ES0.
struct Broken {
  FeaturePointId more, less;
  Axis axis;
  double by;

  [[nodiscard]] bool concerns(FeaturePointId id) const { return id == more || id == less; }
};

std::vector<Broken> broken_relations(const FaceAxes& face) {
  std::vector<Broken> broken;
  for (const Relation& relation : relations) {
    const auto& more = face.place(relation.more);
    const auto& less = face.place(relation.less);
    if (!more || !less) continue;
    const double by = ((*less)[relation.axis] - (*more)[relation.axis]) / *face.eye_separation;
    if (by > tolerance)
      broken.push_back({*parse_feature_point(relation.more), *parse_feature_point(relation.less), relation.axis, by});
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
    finding.measured = {"distance on the wrong side as a fraction of ES0", worst.by, tolerance};
    findings.push_back(std::move(finding));
    broken.erase(broken.begin(), rest);
  }
  return findings;
}

}  // namespace semblante

#include "core/propose/proportion_guess.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "core/propose/proportion_field.h"

namespace semblante {
namespace {

/// The median of each coordinate, robust against an outlier reference.
glm::dvec3 median(const std::vector<glm::dvec3>& places) {
  glm::dvec3 result{0.0};
  std::vector<double> values(places.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < places.size(); ++i) values[i] = places[i][axis];
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    result[axis] = values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
  }
  return result;
}

std::optional<Similarity> pose_of(const ReferenceHead& head, std::span<const KnownPlace> known) {
  std::vector<glm::dvec3> from;
  std::vector<glm::dvec3> to;
  for (const KnownPlace& point : known) {
    if (!head.points[point.id.value()]) continue;
    from.push_back(*head.points[point.id.value()]);
    to.push_back(point.place);
  }
  return fit_similarity(from, to);
}

}  // namespace

std::array<std::optional<Guess>, feature_point_count> guess_by_proportions(std::span<const KnownPlace> known,
                                                                           std::span<const ReferenceHead> references) {
  struct Votes {
    std::vector<glm::dvec3> places;
    double deviation = 0.0;
  };
  std::array<Votes, feature_point_count> votes;
  for (const ReferenceHead& head : references) {
    const std::optional<Similarity> pose = pose_of(head, known);
    if (!pose) continue;
    std::vector<ProportionField::Sample> samples;
    for (const KnownPlace& point : known) {
      const auto& from = head.points[point.id.value()];
      if (from) samples.push_back({(*pose)(*from), point.place, point.noise});
    }
    const ProportionField field(std::move(samples));
    for (std::size_t id = 0; id < feature_point_count; ++id) {
      if (!head.points[id]) continue;
      const ProportionField::Guess guess = field.at((*pose)(*head.points[id]));
      votes[id].places.push_back(guess.place);
      votes[id].deviation += guess.deviation;
    }
  }
  std::array<std::optional<Guess>, feature_point_count> guesses;
  for (std::size_t id = 0; id < feature_point_count; ++id) {
    const std::vector<glm::dvec3>& places = votes[id].places;
    if (places.empty()) continue;
    const glm::dvec3 place = median(places);
    double squares = 0.0;
    for (const glm::dvec3& p : places) squares += glm::dot(p - place, p - place);
    const double count = static_cast<double>(places.size());
    guesses[id] = Guess{place, std::hypot(votes[id].deviation / count, std::sqrt(squares / count))};
  }
  return guesses;
}

}  // namespace semblante

#include "tests/bench/readability/face_reading.h"

#include <array>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace semblante::bench {
namespace {

/// Points of lips, jaw and chin.
bool is_of_mouth(FeaturePointId point) { return group_of(point) == 2 || group_of(point) == 8; }

/// Points of brows, eyes, nose and cheek bones. The soft cheeks (5.1, 5.2) go with mouth and eyes alike.
bool is_of_upper_face(FeaturePointId point) {
  const int group = group_of(point);
  return group == 3 || group == 4 || group == 9 || (group == 5 && number_of(point) >= 3);
}

template <class Of>
double share_of(const WeightTable<float>& rows, std::size_t vertex, Of of) {
  double sum = 0.0;
  const auto points = rows.points_of(vertex);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (of(points[i])) sum += rows.weights_of(vertex)[i];
  }
  return sum;
}

/// Sum of squared distances and of area.
std::array<double, 2> add_up(std::span<const glm::vec3> a, std::span<const glm::vec3> b,
                             std::span<const std::uint32_t> vertices, std::span<const double> area) {
  std::array<double, 2> sum{};
  for (const std::uint32_t v : vertices) {
    const glm::dvec3 apart = glm::dvec3(a[v]) - glm::dvec3(b[v]);
    sum[0] += area[v] * glm::dot(apart, apart);
    sum[1] += area[v];
  }
  return sum;
}

}  // namespace

FaceReading::FaceReading(const PosedFace& face) {
  const Model& model = face.head().model;
  eye_separation_ = 1024.0 * face.rig().fapu[FapuUnit::es].value();
  for (std::uint8_t v = 0; v < visemes; ++v) {
    for (std::uint8_t e = 0; e < expressions; ++e) poses_.push_back(face.pose(frame_of(v, e)));
  }
  area_.resize(model.positions.size());
  std::vector<char> is_skin(model.positions.size(), 0);
  for (const Triangle& t : model.triangles) {
    if (face.role_of(t[0]) != PartRole::skin) continue;
    const glm::dvec3 a(model.positions[t[0]]);
    const double size =
        glm::length(glm::cross(glm::dvec3(model.positions[t[1]]) - a, glm::dvec3(model.positions[t[2]]) - a)) / 2.0;
    for (const std::uint32_t corner : t) {
      area_[corner] += size / 3.0;
      is_skin[corner] = 1;
    }
  }
  for (std::uint32_t v = 0; v < model.positions.size(); ++v) {
    if (is_skin[v] == 0) continue;
    if (share_of(face.rig().influence, v, is_of_mouth) >= 0.5) mouth_.push_back(v);
    if (share_of(face.rig().influence, v, is_of_upper_face) >= 0.5) upper_face_.push_back(v);
  }
}

double FaceReading::distance(std::span<const glm::vec3> a, std::span<const glm::vec3> b, Region region) const {
  const auto [sum, area] = add_up(a, b, region == Region::mouth ? mouth_ : upper_face_, area_);
  return std::sqrt(sum / area) / eye_separation_;
}

double FaceReading::distance(std::span<const glm::vec3> a, std::span<const glm::vec3> b) const {
  const auto [mouth_sum, mouth_area] = add_up(a, b, mouth_, area_);
  const auto [upper_sum, upper_area] = add_up(a, b, upper_face_, area_);
  return std::sqrt((mouth_sum + upper_sum) / (mouth_area + upper_area)) / eye_separation_;
}

FaceReading::Nearest FaceReading::read_viseme(std::size_t viseme, std::size_t expression) const {
  Nearest nearest{0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (std::size_t v = 1; v < visemes; ++v) {
    const double d = distance(pose(viseme, expression), pose(v, 0), Region::mouth);
    if (d < nearest.distance) {
      nearest = {v, d, nearest.distance};
    } else if (d < nearest.second) {
      nearest.second = d;
    }
  }
  return nearest;
}

FaceReading::Nearest FaceReading::read_expression(std::size_t viseme, std::size_t expression) const {
  Nearest nearest{0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (std::size_t e = 0; e < expressions; ++e) {
    const double d = distance(pose(viseme, expression), pose(0, e), Region::upper_face);
    if (d < nearest.distance) {
      nearest = {e, d, nearest.distance};
    } else if (d < nearest.second) {
      nearest.second = d;
    }
  }
  return nearest;
}

}  // namespace semblante::bench

#include "deploy/sample_head/scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <string_view>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "deploy/sample_head/half_mesh.h"

namespace semblante::sample_head_detail {
namespace {

using std::numbers::pi;

constexpr int scan_rows = 180;
constexpr int scan_columns = 168;
constexpr double axis_z = -1.5;  ///< the vertical axis from which all rays start, at x = 0

/// A number in -1..1 that depends on its arguments alone.
double noise(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  std::uint32_t h = a * 0x9E3779B1U ^ b * 0x85EBCA77U ^ c * 0xC2B2AE3DU;
  h = (h ^ (h >> 15U)) * 0x2C1B3C6DU;
  h = (h ^ (h >> 12U)) * 0x297A2D39U;
  return static_cast<double>(h ^ (h >> 15U)) / 2147483647.5 - 1.0;
}

struct Ray {
  Vec3 origin, direction;
};

/// The ray of a row 0..1 (crown to hem) and an azimuth (0: front, pi/2: left).
Ray ray_of(double row, double azimuth) {
  double height = 0.0;     // of the origin, cm
  double elevation = 0.0;  // radians
  if (row < 0.22) {
    height = 3.0;
    elevation = 0.5 * pi * (1.0 - row / 0.22);
  } else if (row < 0.76) {
    height = glm::mix(3.0, -10.5, (row - 0.22) / 0.54);
  } else if (row < 0.80) {
    height = glm::mix(-10.5, -14.0, (row - 0.76) / 0.04);
  } else if (row < 0.84) {
    const double t = (row - 0.80) / 0.04;
    height = glm::mix(-14.0, -20.5, t);
    elevation = glm::radians(40.0) * t;  // a steeper ray would meet the chin
  } else {
    // Chest and back are lower than the arms, and the back is farther from the axis.
    const double forward = std::cos(azimuth);
    const double hem = glm::mix(-10.0, -32.0 - 4.0 * forward, forward * forward);
    height = -20.5;
    elevation = glm::radians(glm::mix(40.0, hem, (row - 0.84) / 0.16));
  }
  const double flat = std::cos(elevation);
  return {{0.0, height, axis_z}, {flat * std::sin(azimuth), std::sin(elevation), flat * std::cos(azimuth)}};
}

/// The triangles of a head, found by their azimuth about the axis.
class Outside {
 public:
  explicit Outside(const SampleHead& head) {
    for (const SampleHeadMesh& mesh : head.meshes) {
      for (const auto& t : mesh.triangles) {
        const std::array<Vec3, 3> corners = {Vec3(mesh.positions[t[0]]) * 100.0, Vec3(mesh.positions[t[1]]) * 100.0,
                                             Vec3(mesh.positions[t[2]]) * 100.0};
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (const Vec3& p : corners) {
          const double azimuth = azimuth_of(p);
          low = std::min(low, azimuth);
          high = std::max(high, azimuth);
        }
        // A triangle at the axis or across the back is in every sector.
        const bool everywhere = high - low > 0.5 * pi;
        const std::size_t first = everywhere ? 0 : sector_of(low);
        const std::size_t last = everywhere ? sectors_.size() - 1 : sector_of(high);
        for (std::size_t s = first; s <= last; ++s) sectors_[s].push_back(corners);
      }
    }
  }

  /// The farthest hit, which is the first one from outside.
  [[nodiscard]] std::optional<Vec3> hit(const Ray& ray) const {
    double farthest = -1.0;
    for (const auto& [a, b, c] : sectors_[sector_of(azimuth_of(ray.origin + ray.direction))]) {
      const Vec3 ab = b - a;
      const Vec3 ac = c - a;
      const Vec3 across = glm::cross(ray.direction, ac);
      const double det = glm::dot(ab, across);
      if (std::abs(det) < 1e-12) continue;
      const Vec3 from = ray.origin - a;
      const double u = glm::dot(from, across) / det;
      const Vec3 side = glm::cross(from, ab);
      const double v = glm::dot(ray.direction, side) / det;
      if (u < -1e-9 || v < -1e-9 || u + v > 1.0 + 1e-9) continue;
      farthest = std::max(farthest, glm::dot(ac, side) / det);
    }
    if (farthest < 0.0) return std::nullopt;
    return ray.origin + ray.direction * farthest;
  }

 private:
  static double azimuth_of(const Vec3& p) { return std::atan2(p.x, p.z - axis_z); }
  [[nodiscard]] std::size_t sector_of(double azimuth) const {
    const auto sector = static_cast<std::size_t>((azimuth / pi + 1.0) * 0.5 * static_cast<double>(sectors_.size()));
    return std::min(sector, sectors_.size() - 1);
  }

  std::vector<std::vector<std::array<Vec3, 3>>> sectors_{512};
};

/// The place of a point of the symmetric head on the scanned person: a broader left half, a mouth that is a little
/// aslant, cm.
Vec3 asymmetric(const Vec3& p) {
  const double face = glm::smoothstep(-14.0, -2.0, p.y);
  return {p.x * (p.x > 0.0 ? 1.015 : 1.0) + 0.12 * std::sin(0.3 * p.y) * face, p.y + 0.012 * p.x * face, p.z};
}

void compute_normals(SampleHeadMesh& mesh) {
  std::vector<Vec3> sums(mesh.positions.size(), Vec3(0.0));
  for (const auto& t : mesh.triangles) {
    const Vec3 a(mesh.positions[t[0]]);
    const Vec3 across = glm::cross(Vec3(mesh.positions[t[1]]) - a, Vec3(mesh.positions[t[2]]) - a);
    for (const std::uint32_t v : t) sums[v] += across;
  }
  for (const Vec3& sum : sums) mesh.normals.emplace_back(glm::normalize(sum));
}

SampleHeadMesh make_surface(const Outside& outside) {
  SampleHeadMesh mesh;
  mesh.name = "scan";
  const auto add = [&](const Vec3& p, const Vec2& uv) {
    mesh.positions.emplace_back(asymmetric(p) * 0.01);
    mesh.uvs.emplace_back(uv);
  };
  std::vector<Vec3> above(scan_columns, Vec3(0.0));
  for (std::uint32_t r = 0; r < scan_rows; ++r) {
    for (std::uint32_t c = 0; c < scan_columns; ++c) {
      const bool at_border = r == 0 || r + 1 == scan_rows;
      const double row = (r + 1.0 + (at_border ? 0.0 : 0.3 * noise(r, c, 1))) / scan_rows;
      const double turn = 2.0 * (c + 0.3 * noise(r, c, 2)) / scan_columns - 1.0;
      const Ray ray = ray_of(row, pi * turn * (0.5 + 0.5 * std::abs(turn)));  // denser in front
      const auto hit = outside.hit(ray);
      const Vec3 p = hit ? *hit + ray.direction * (0.006 * noise(r, c, 3)) : above[c];
      above[c] = p;
      add(p, {0.5 + 0.499 * turn, row});
    }
  }
  const Ray up{{0.0, 3.0, axis_z}, {0.0, 1.0, 0.0}};
  add(outside.hit(up).value_or(Vec3(0.0, 12.0, axis_z)), {0.5, 0.0});
  const auto at = [](std::uint32_t r, std::uint32_t c) { return r * scan_columns + c % scan_columns; };
  for (std::uint32_t c = 0; c < scan_columns; ++c)
    mesh.triangles.push_back({scan_rows * scan_columns, at(0, c), at(0, c + 1)});
  for (std::uint32_t r = 0; r + 1 < scan_rows; ++r) {
    for (std::uint32_t c = 0; c < scan_columns; ++c) {
      const std::array<std::uint32_t, 4> q = {at(r, c), at(r + 1, c), at(r + 1, c + 1), at(r, c + 1)};
      if (noise(r, c, 4) < 0.0) {
        mesh.triangles.push_back({q[0], q[1], q[2]});
        mesh.triangles.push_back({q[0], q[2], q[3]});
      } else {
        mesh.triangles.push_back({q[0], q[1], q[3]});
        mesh.triangles.push_back({q[1], q[2], q[3]});
      }
    }
  }
  compute_normals(mesh);
  return mesh;
}

/// Lips and lids are at one place where they are joined, and so are the two corners of the mouth: the search is moved
/// to the side that the point is on, cm.
Vec3 search_offset(std::string_view id) {
  if (id == "2.4" || id == "8.4") return {-0.1, 0.0, 0.0};
  if (id == "2.5" || id == "8.3") return {0.1, 0.0, 0.0};
  for (const std::string_view upper : {"2.2", "2.6", "2.7", "3.1", "3.2"}) {
    if (id == upper) return {0.0, 0.12, 0.0};
  }
  for (const std::string_view lower : {"2.3", "2.8", "2.9", "3.3", "3.4"}) {
    if (id == lower) return {0.0, -0.12, 0.0};
  }
  return Vec3(0.0);
}

bool is_inside(std::string_view id) {
  return id.starts_with("6.") || id == "9.8" || id == "9.9" || id == "9.10" || id == "9.11";
}

}  // namespace

SampleHead scan_of(const SampleHead& head) {
  SampleHead scan;
  scan.name = "sample-scan";
  scan.is_symmetric = false;
  scan.materials = {{"scan", glm::vec4(0.55F, 0.36F, 0.28F, 1.0F), 0.7F, std::nullopt, false}};
  scan.meshes.push_back(make_surface(Outside(head)));
  const SampleHeadMesh& mesh = scan.meshes.front();
  std::set<std::uint32_t> taken;
  for (const SampleHeadPoint& point : head.points) {
    const std::string id = to_string(point.id);
    if (is_inside(id)) continue;
    // The fold of the lid is behind the skin on the head, and at the end of the eye's shadow on a scan.
    const bool is_fold = id == "3.13" || id == "3.14";
    const Vec3 origin = is_fold ? Vec3(id == "3.13" ? 3.2 : -3.2, 0.9, 8.0) : Vec3(point.position) * 100.0;
    const Vec3 place = asymmetric(origin);
    if (!point.vertex || id == "3.5" || id == "3.6") {
      scan.points.push_back({point.id, std::nullopt, glm::vec3(place * 0.01)});
      continue;
    }
    const glm::vec3 wanted(0.01 * (place + search_offset(id)));
    std::uint32_t nearest = 0;
    float least = std::numeric_limits<float>::infinity();
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
      const float distance = glm::distance(mesh.positions[v], wanted);
      if (distance < least && !taken.contains(v)) {
        least = distance;
        nearest = v;
      }
    }
    taken.insert(nearest);
    scan.points.push_back({point.id, nearest, mesh.positions[nearest]});
  }
  return scan;
}

}  // namespace semblante::sample_head_detail

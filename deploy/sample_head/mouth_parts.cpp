#include "deploy/sample_head/mouth_parts.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace semblante::sample_head_detail {
namespace {

using std::numbers::pi;

/// Widths of the teeth from the middle outwards, in cm: incisors, canine, premolars, molars.
constexpr double upper_widths[] = {0.60, 0.46, 0.54, 0.48, 0.48, 0.70, 0.66};
constexpr double lower_widths[] = {0.38, 0.40, 0.50, 0.48, 0.50, 0.74, 0.70};
constexpr int steps_per_tooth = 4;

/// A row of teeth on its gum. Cross-sections run from the gum's front edge over the biting edge to the gum's back edge.
struct Arch {
  double front_z;  ///< of the incisors' faces
  double width;    ///< half width at the last molar
  double depth;    ///< from the incisors back to the last molar
  double root_y;   ///< edge of the gum
  double bite_y;   ///< biting edge
};

/// Point of the arch at length s (cm) from the middle and its outward direction: a parabola-like curve, integrated in
/// small steps.
struct ArchPoint {
  Vec2 place;    ///< x, z
  Vec2 outward;  ///< x, z
};

ArchPoint arch_at(const Arch& arch, double s) {
  const auto point = [&](double t) {  // t: 0 middle .. 1 last molar
    const double a = 0.5 * pi * t;
    return Vec2(arch.width * std::pow(std::sin(a), 0.92),
                arch.front_z - arch.depth * (1.0 - std::pow(std::cos(a), 0.9)));
  };
  constexpr int steps = 400;
  double length = 0.0;
  double t = 0.0;
  Vec2 p = point(0.0);
  for (int i = 1; i <= steps && length < s; ++i) {
    t = static_cast<double>(i) / steps * 0.93;
    const Vec2 next = point(t);
    length += glm::length(next - p);
    p = next;
  }
  const Vec2 along = point(t + 0.01) - point(std::max(t - 0.01, 0.0));
  return {p, glm::normalize(t == 0.0 ? Vec2(0.0, 1.0) : Vec2(-along.y, along.x))};
}

MouthPart make_teeth(const Arch& arch, std::span<const double> widths) {
  struct Section {
    double height;   ///< 0 gum edge .. 1 biting edge
    double outward;  ///< cm from the face of the tooth
    double tooth;    ///< how much of the tooth's rounding applies
    double gum;      ///< paint: 1 gum
  };
  constexpr Section sections[] = {
      {0.00, -0.02, 0.0, 1.0}, {0.22, 0.05, 0.2, 1.0},  {0.40, 0.05, 0.4, 1.0},  {0.46, -0.01, 0.9, 0.0},
      {0.65, 0.03, 1.0, 0.0},  {0.85, 0.0, 1.0, 0.0},   {0.97, -0.05, 1.0, 0.0}, {1.00, -0.12, 1.0, 0.0},
      {0.95, -0.22, 0.8, 0.0}, {0.60, -0.34, 0.5, 0.0}, {0.42, -0.42, 0.2, 1.0}, {0.00, -0.55, 0.0, 1.0},
  };
  constexpr std::size_t front_top = 0;
  constexpr std::size_t edge = 7;
  MouthPart part;
  std::vector<Loop> columns;
  double start = 0.0;
  for (std::size_t tooth = 0; tooth < widths.size(); ++tooth) {
    for (int step = tooth == 0 ? 0 : 1; step <= steps_per_tooth; ++step) {
      const double f = static_cast<double>(step) / steps_per_tooth;
      const ArchPoint at = arch_at(arch, start + widths[tooth] * f);
      const double between = std::pow(std::abs(2.0 * f - 1.0), 3.0);  // 1 in the gap between two teeth
      const double thick = 1.0 + 0.9 * glm::smoothstep(2.0, 5.0, static_cast<double>(tooth));
      Loop column;
      for (const Section& section : sections) {
        const double notch = between * section.tooth;
        const double out = (section.outward < -0.1 ? section.outward * thick : section.outward) - 0.10 * notch;
        const double height = section.height - 0.05 * notch * glm::smoothstep(0.8, 1.0, section.height) +
                              0.10 * between * section.gum * glm::smoothstep(0.3, 0.4, section.height);
        Vec2 p = at.place + at.outward * out;
        if (tooth == 0 && step == 0) p.x = 0.0;
        Paint paint;
        paint.lip = section.gum;
        column.push_back(part.mesh.add({p.x, glm::mix(arch.root_y, arch.bite_y, height), p.y}, paint));
      }
      if (!columns.empty()) bridge(part.mesh, columns.back(), column, false, Chart::outer);
      columns.push_back(column);
    }
    start += widths[tooth];
  }
  orient(part.mesh, {0.0, 0.0, 1.0});
  part.marks["root"] = columns[0][front_top];
  part.marks["edge"] = columns[0][edge];
  return part;
}

}  // namespace

MouthPart make_upper_teeth() {
  MouthPart part = make_teeth({8.98, 2.52, 3.9, -5.15, -6.90}, upper_widths);
  part.marks = {{"9.8", part.marks["root"]}, {"9.10", part.marks["edge"]}};
  return part;
}

MouthPart make_lower_teeth() {
  MouthPart part = make_teeth({8.76, 2.42, 3.8, -8.45, -6.82}, lower_widths);
  part.marks = {{"9.9", part.marks["root"]}, {"9.11", part.marks["edge"]}};
  return part;
}

MouthPart make_tongue() {
  // Cross-sections from root to tip: z, half width, height of the back, thickness.
  struct Section {
    double z, width, top, thickness;
  };
  constexpr Section sections[] = {
      {4.3, 1.3, -6.95, 0.9},  {4.8, 1.65, -6.50, 1.3}, {5.4, 1.85, -6.20, 1.55}, {6.1, 1.90, -6.08, 1.55},
      {6.8, 1.75, -6.10, 1.3}, {7.4, 1.50, -6.22, 1.0}, {7.85, 1.15, -6.40, 0.7}, {8.12, 0.7, -6.56, 0.44},
  };
  constexpr std::size_t middle_section = 3;
  constexpr int steps = 12;  // half way round: top middle, side, bottom middle
  MouthPart part;
  HalfMesh& mesh = part.mesh;
  Loop before;
  std::vector<Loop> rings;
  for (const Section& s : sections) {
    Loop ring;
    for (int k = 0; k <= steps; ++k) {
      const double a = pi * k / steps;
      const bool middle = k == 0 || k == steps;
      const double x = middle ? 0.0 : s.width * std::pow(std::sin(a), 0.75);
      const double groove = 0.10 * std::exp(-x * x / 0.06) * (k < steps / 2 ? 1.0 : 0.0);
      const double y = s.top - 0.5 * s.thickness * (1.0 - std::cos(a)) - groove;
      ring.push_back(mesh.add({x, y, s.z}));
    }
    if (!before.empty()) bridge(mesh, before, ring, false, Chart::outer);
    before = ring;
    rings.push_back(ring);
  }
  const int tip = mesh.add({0.0, -6.80, 8.24});
  close_with_fan(mesh, before, false, tip, Chart::outer);
  const int root = mesh.add({0.0, -7.5, 4.0});
  close_with_fan(mesh, rings[0], false, root, Chart::outer);
  orient(mesh, {0.0, 1.0, 0.0});
  part.marks["6.1"] = tip;
  part.marks["6.2"] = rings[middle_section][0];
  part.marks["6.3"] = rings[middle_section][steps / 2];
  return part;
}

}  // namespace semblante::sample_head_detail

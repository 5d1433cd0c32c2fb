#include "core/anatomy/neck_shape.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/open_edge.h"

namespace semblante {
namespace {

// Lengths in units of the height from the chin to the eyes. Human proportions; the shoulders are measured.
constexpr double step_down = 0.05;             ///< between the sections of the neck
constexpr double longest_neck = 1.6;           ///< the narrowest section is no farther below the chin
constexpr double shortest_neck = 0.3;          ///< if the neck is cut nearer to the chin, the head turns as a whole
constexpr double shoulder_widening = 1.6;      ///< shoulders begin where the neck is wider than its least by this
constexpr double joint_from_shoulders = 0.75;  ///< farther from the neck's joint no shoulders begin

/// A horizontal section of the skin near the neck's axis.
struct NeckSection {
  double low = std::numeric_limits<double>::infinity(), high = -low;       ///< x
  double front = -std::numeric_limits<double>::infinity(), back = -front;  ///< z
  [[nodiscard]] double width() const { return high - low; }
};

/// The sections from the chin down, `step_down` apart.
std::vector<NeckSection> neck_sections(const Surface& surface, const std::vector<bool>& is_skin,
                                       const HeadLandmarks& marks) {
  const double step = step_down * marks.height;
  std::vector<NeckSection> sections(static_cast<std::size_t>(shoulders_within / step_down) + 1);
  const auto last = static_cast<double>(sections.size() - 1);
  for (std::uint32_t s = 0; s < surface.vertex_count(); ++s) {
    if (!is_skin[s]) continue;
    const glm::dvec3& a = surface.positions[s];
    for (const Surface::Step& edge : surface.steps_from(SurfaceVertexId(s))) {
      const glm::dvec3& b = surface.positions[edge.to.value()];
      if (b.y >= a.y) continue;  // each edge once, downwards
      const auto from = static_cast<std::size_t>(std::clamp(std::ceil((marks.chin.y - a.y) / step), 0.0, last + 1.0));
      const auto end = static_cast<std::size_t>(std::clamp(std::floor((marks.chin.y - b.y) / step), -1.0, last) + 1.0);
      for (std::size_t k = from; k < end; ++k) {
        const double height = marks.chin.y - static_cast<double>(k) * step;
        const glm::dvec3 p = a + (b - a) * ((a.y - height) / (a.y - b.y));
        NeckSection& section = sections[k];
        section.low = std::min(section.low, p.x);
        section.high = std::max(section.high, p.x);
        section.front = std::max(section.front, p.z);
        section.back = std::min(section.back, p.z);
      }
    }
  }
  return sections;
}

/// y of the highest border that is no small hole: sections below it are not whole. Minus infinity without one.
double end_of_whole_sections(std::span<const SkinBorder> borders, const std::vector<NeckSection>& sections,
                             std::size_t first) {
  double top = -std::numeric_limits<double>::infinity();
  for (const SkinBorder& border : borders) {
    if (border.high - border.low >= spanning * sections[first].width()) top = std::max(top, border.top);
  }
  return top;
}

}  // namespace

std::vector<SkinBorder> borders_below_jaw(const Surface& surface, const std::vector<bool>& is_skin,
                                          const HeadLandmarks& marks) {
  std::vector<SkinBorder> borders;
  std::vector<bool> seen(surface.vertex_count(), false);
  const auto is_below = [&](SurfaceVertexId v) {
    return is_skin[v.value()] && !above_jaw(marks, surface.positions[v.value()]);
  };
  for (std::uint32_t s = 0; s < surface.vertex_count(); ++s) {
    if (seen[s] || !is_below(SurfaceVertexId(s))) continue;
    SkinBorder border;
    std::vector<SurfaceVertexId> pending = {SurfaceVertexId(s)};
    while (!pending.empty()) {
      const SurfaceVertexId v = pending.back();
      pending.pop_back();
      bool is_open = false;
      for (const Surface::Step& step : surface.steps_from(v)) {
        if (!is_below(step.to) || !is_open_edge(surface, v, step.to)) continue;
        is_open = true;
        if (!seen[step.to.value()]) pending.push_back(step.to);
        seen[step.to.value()] = true;
      }
      if (!is_open) continue;
      seen[v.value()] = true;
      const glm::dvec3& p = surface.positions[v.value()];
      border.vertices.push_back(v);
      border.low = std::min(border.low, p.x);
      border.high = std::max(border.high, p.x);
      border.top = std::max(border.top, p.y);
    }
    if (!border.vertices.empty()) borders.push_back(std::move(border));
  }
  return borders;
}

std::optional<NeckShape> find_neck_shape(const Surface& surface, const std::vector<bool>& is_skin,
                                         const HeadLandmarks& marks, std::span<const SkinBorder> borders) {
  const std::vector<NeckSection> sections = neck_sections(surface, is_skin, marks);
  const double step = step_down * marks.height;
  const auto first = static_cast<std::size_t>(first_section / step_down);
  const auto lowest = static_cast<std::size_t>(longest_neck / step_down);
  const double whole = end_of_whole_sections(borders, sections, first);
  std::optional<std::size_t> narrowest;
  std::size_t end = first;
  for (; end < sections.size() && sections[end].width() > 0.0; ++end) {
    if (end > lowest || (narrowest && marks.chin.y - static_cast<double>(end) * step <= whole)) continue;
    if (!narrowest || sections[end].width() < sections[*narrowest].width()) narrowest = end;
  }
  if (!narrowest) return std::nullopt;
  const NeckSection& waist = sections[*narrowest];
  NeckShape neck;
  neck.axis = {0.5 * (waist.low + waist.high), marks.chin.y - static_cast<double>(*narrowest) * step,
               0.5 * (waist.front + waist.back)};
  neck.radius = 0.5 * waist.width();
  for (std::size_t k = *narrowest; k < end; ++k) {
    if (sections[k].width() <= shoulder_widening * waist.width()) continue;
    neck.shoulders = marks.chin.y - static_cast<double>(k) * step;
    return neck;
  }
  neck.is_cut = true;
  double lowest_skin = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < is_skin.size(); ++s) {
    if (is_skin[s]) lowest_skin = std::min(lowest_skin, surface.positions[s].y);
  }
  neck.shoulders = lowest_skin + border_height * marks.height;
  if (marks.chin.y - neck.shoulders < shortest_neck * marks.height) return std::nullopt;
  return neck;
}

void start_shoulders_at(const SkinJoint& joint, const HeadLandmarks& marks, NeckShape& neck) {
  if (std::abs(neck.shoulders - static_cast<double>(joint.position.y)) > joint_from_shoulders * marks.height)
    neck.shoulders = joint.position.y;
}

}  // namespace semblante

#include "core/anatomy/modelled_rims.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

namespace semblante {
namespace {

// Lengths in widths of the expected eye.
/// The eye is looked for within a lens of this width and this height about the expected middle.
constexpr double window_width = 1.5;
constexpr double window_height = 1.0;
/// From the expected middle: where a patch may begin.
constexpr std::array<std::pair<double, double>, 11> beginnings = {{{0.0, 0.0},
                                                                   {0.15, 0.0},
                                                                   {-0.15, 0.0},
                                                                   {0.0, 0.12},
                                                                   {0.0, -0.12},
                                                                   {0.3, 0.0},
                                                                   {-0.3, 0.0},
                                                                   {0.15, 0.12},
                                                                   {-0.15, 0.12},
                                                                   {0.15, -0.12},
                                                                   {-0.15, -0.12}}};
/// The width of an open eye, and its height as a share of its width.
constexpr double least_width = 0.55;
constexpr double greatest_width = 1.4;
constexpr double least_height = 0.12;
constexpr double greatest_height = 0.8;
/// From where the eye ends, the surface steps forward of its ball by `step_of_lid` within `way_of_step`: in at least
/// the share `least_stepped` of all directions.
constexpr double step_of_lid = 0.03;
constexpr double way_of_step = 0.06;
constexpr double least_stepped = 0.75;
constexpr int directions = 48;
/// The inner corner of the lids is this far beyond the end of the eye, and lower: the caruncle is between them.
constexpr double inner_corner = 0.09;
constexpr double below_end = 0.04;
/// Greatest width times height of an eye, as a multiple of that of the expected opening: a larger patch is a closed
/// lid, from its fold to its edge.
constexpr double greatest_size = 1.2;

LidPlaces window_of(const LidPlaces& expected, double width) {
  const glm::dvec3 middle = EyeOpening(expected, 0.0).middle();
  const glm::dvec3 aside(0.5 * window_width * width, 0.0, 0.0);
  const glm::dvec3 up(0.0, 0.5 * window_height * width, 0.0);
  return {middle + up, middle - up, middle + aside, middle - aside};
}

/// What is seen of the eye: one piece, the greatest.
class SeenPiece {
 public:
  explicit SeenPiece(const EyeSkin::View& view) : view_(view), of_piece_(view.is_eye.size(), false) {
    std::vector<bool> known = of_piece_;
    for (std::size_t at = 0; at < known.size(); ++at) {
      if (known[at] || !view.is_eye[at]) continue;
      std::vector<std::size_t> piece = {at};
      known[at] = true;
      for (std::size_t k = 0; k < piece.size(); ++k) {
        const auto row = static_cast<int>(piece[k]) / view.columns;
        const auto column = static_cast<int>(piece[k]) % view.columns;
        for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
          if (!view.is_in(column + dx, row + dy)) continue;
          const std::size_t next = view.at(column + dx, row + dy);
          if (known[next] || !view.is_eye[next]) continue;
          known[next] = true;
          piece.push_back(next);
        }
      }
      if (piece.size() > size_) {
        size_ = piece.size();
        of_piece_.assign(of_piece_.size(), false);
        for (const std::size_t knot : piece) of_piece_[knot] = true;
      }
    }
  }

  [[nodiscard]] const EyeSkin::View& view() const { return view_; }
  [[nodiscard]] bool contains(int column, int row) const {
    return view_.is_in(column, row) && of_piece_[view_.at(column, row)];
  }
  /// The lowest and the highest row of a column.
  [[nodiscard]] std::optional<std::pair<int, int>> rows_at(int column) const {
    std::optional<std::pair<int, int>> rows;
    for (int row = 0; row < view_.rows; ++row) {
      if (!contains(column, row)) continue;
      if (!rows) rows = std::pair(row, row);
      rows->second = row;
    }
    return rows;
  }

  /// The share of the directions from the middle in which the surface steps forward of the ball where the eye ends.
  [[nodiscard]] double stepped_share(const Sphere& ball, double width) const {
    double x = 0.0;
    double y = 0.0;
    for (int row = 0; row < view_.rows; ++row) {
      for (int column = 0; column < view_.columns; ++column) {
        if (!contains(column, row)) continue;
        x += column / static_cast<double>(size_);
        y += row / static_cast<double>(size_);
      }
    }
    const double way = way_of_step * width / view_.step;
    int stepped = 0;
    for (int k = 0; k < directions; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / directions;
      const auto at = [&](int half_step) {
        const double r = 0.5 * half_step;
        return std::pair(static_cast<int>(std::lround(x + r * std::cos(angle))),
                         static_cast<int>(std::lround(y + r * std::sin(angle))));
      };
      int end = 0;
      for (int half_step = 0; half_step < 2 * view_.columns; ++half_step) {
        const auto [column, row] = at(half_step);
        if (contains(column, row)) end = half_step;
      }
      for (int half_step = end; 0.5 * half_step <= 0.5 * end + way; ++half_step) {
        const auto [column, row] = at(half_step);
        if (!view_.is_in(column, row) || contains(column, row) || !std::isfinite(view_.z[view_.at(column, row)]))
          continue;
        if (glm::distance(view_.place(column, row), ball.center) < ball.radius + step_of_lid * width) continue;
        ++stepped;
        break;
      }
    }
    return static_cast<double>(stepped) / directions;
  }

 private:
  const EyeSkin::View& view_;
  std::vector<bool> of_piece_;
  std::size_t size_ = 0;
};

/// The place that is seen aside of a knot, as far as there is one.
glm::dvec3 beside(const EyeSkin::View& view, int column, int row, double aside, double up) {
  const int to_column = column + static_cast<int>(std::lround(aside / view.step));
  const int to_row = row + static_cast<int>(std::lround(up / view.step));
  if (!view.is_in(to_column, to_row)) return view.place(column, row);
  const glm::dvec3 place = view.place(to_column, to_row);
  return std::isfinite(place.z) ? place : view.place(column, row);
}

/// The edges of a piece that has the size of an open eye.
std::optional<ModelledRims> rims_of(const SeenPiece& piece, const LidPlaces& expected, double expected_width) {
  const EyeSkin::View& view = piece.view();
  ModelledRims rims;
  std::vector<std::pair<int, int>> ends;  // columns and rows of the middle between the edges
  double height = 0.0;
  for (int column = 0; column < view.columns; ++column) {
    const auto rows = piece.rows_at(column);
    if (!rows) continue;
    const auto [lower, upper] = *rows;
    ends.emplace_back(column, (lower + upper) / 2);
    rims.columns.push_back({view.place(column, upper), view.place(column, lower)});
    height = std::max(height, (upper - lower) * view.step);
  }
  const double width = static_cast<double>(ends.size()) * view.step;
  if (width < least_width * expected_width || width > greatest_width * expected_width) return std::nullopt;
  if (height < least_height * width || height > greatest_height * width) return std::nullopt;
  if (width * height > greatest_size * expected_width * (expected.upper.y - expected.lower.y)) return std::nullopt;
  const auto& [first, right_row] = ends.front();
  const auto& [last, left_row] = ends.back();
  const double aside = inner_corner * expected_width;
  const double down = below_end * expected_width;
  const bool is_left_eye = expected.left.x + expected.right.x > 0.0;
  rims.right = is_left_eye ? beside(view, first, right_row, -aside, -down) : view.place(first, right_row);
  rims.left = is_left_eye ? view.place(last, left_row) : beside(view, last, left_row, aside, -down);
  return rims;
}

}  // namespace

const ModelledRims::Column& ModelledRims::at(double x) const {
  return *std::min_element(columns.begin(), columns.end(), [x](const Column& a, const Column& b) {
    return std::abs(a.upper.x - x) < std::abs(b.upper.x - x);
  });
}

bool ModelledRims::is_of_eye(SurfaceVertexId vertex) const {
  return std::binary_search(of_eye.begin(), of_eye.end(), vertex);
}

bool ModelledRims::surround(const glm::dvec3& place) const {
  if (place.x < columns.front().upper.x || columns.back().upper.x < place.x) return false;
  const Column& edges = at(place.x);
  return edges.lower.y < place.y && place.y < edges.upper.y;
}

std::optional<ModelledRims> find_modelled_rims(const Surface& surface, std::span<const glm::dvec3> places,
                                               std::span<const Triangle> triangles, PartId part,
                                               const LidPlaces& expected) {
  const double width = glm::distance(expected.left, expected.right);
  if (!(width > 0.0)) return std::nullopt;
  const EyeOpening window(window_of(expected, width), 0.0);
  EyeSkin skin(surface, places, triangles, part, window, width);
  std::optional<ModelledRims> best;
  double most = least_stepped;
  EyeSkin::View view;
  std::vector<bool> known;
  for (const auto& [aside, up] : beginnings) {
    const glm::dvec3 from = window.middle() + width * glm::dvec3(aside, up, 0.0);
    // What another patch has already reached is the same eye again.
    if (!known.empty() && known[view.knot(from)]) continue;
    if (!skin.grow_from(from) || !skin.fitted()) continue;
    skin.add_holes();
    view = skin.view();
    known.resize(view.is_eye.size());
    std::transform(known.begin(), known.end(), view.is_eye.begin(), known.begin(), std::logical_or<>());
    const SeenPiece piece(view);
    const double stepped = piece.stepped_share(*skin.fitted(), width);
    if (stepped <= most) continue;
    auto rims = rims_of(piece, expected, width);
    if (!rims) continue;
    rims->of_eye = skin.vertices_on_ball();
    most = stepped;
    best = std::move(rims);
  }
  return best;
}

}  // namespace semblante

#include "core/propose/seen_mouth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <vector>

#include <glm/geometric.hpp>

namespace semblante {
namespace {

// All in ES0.

/// Heights at which a mouth may be, and steps of looking for it.
constexpr double mouth_top = -0.40;
constexpr double mouth_bottom = -2.0;
constexpr double step_down = 0.01;
constexpr double step_aside = 0.02;
constexpr double fine_step_aside = 0.005;
/// Two places that are seen one below the other are on different lips if the way between them, through the mouth, has
/// at least this length and is at least this multiple of their distance. The way behind a nose or chin that juts out is
/// shorter.
constexpr double least_way = 0.10;
constexpr double least_detour = 3.0;
/// A mouth at rest is open by less.
constexpr double widest_opening = 0.5;
/// By which the inside of a mouth is seen behind the lips.
constexpr double least_depth = 0.3;
/// Beside the middle lips are looked for up to this much above and below those of the column before: nostrils are
/// farther.
constexpr double above_lips = 0.15;
/// The line of the mouth rises or falls by less from column to column.
constexpr double steepest_step = 0.05;
constexpr double least_mouth_width = 0.2;

/// The line in which a column cuts the skin.
class SkinLine {
 public:
  explicit SkinLine(const std::vector<FrontColumn::Piece>& pieces) : pieces_(pieces) {
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      for (const auto& edge : pieces[p].edges) at_edge_[edge].push_back(p);
    }
  }

  struct Place {
    std::size_t piece;
    glm::dvec3 at;
  };
  /// The length of the line between two places; infinite where it is longer than `limit`, or does not join them.
  [[nodiscard]] double way(const Place& from, const Place& to, double limit) const {
    if (from.piece == to.piece) return glm::distance(from.at, to.at);
    return std::min(way_by(0, from, to, limit), way_by(1, from, to, limit));
  }

 private:
  [[nodiscard]] double way_by(std::size_t end, const Place& from, const Place& to, double limit) const {
    std::size_t piece = from.piece;
    double length = glm::distance(from.at, pieces_[piece].ends[end]);
    // Pieces without a length may lie in a ring: no line has more pieces than there are.
    for (std::size_t count = 0; count < pieces_.size() && length <= limit; ++count) {
      const auto& edge = pieces_[piece].edges[end];
      const std::vector<std::size_t>& here = at_edge_.at(edge);
      const auto next = std::find_if(here.begin(), here.end(), [&](std::size_t p) { return p != piece; });
      if (next == here.end()) break;
      piece = *next;
      const std::size_t entry = pieces_[piece].edges[0] == edge ? 0 : 1;
      if (piece == to.piece) return length + glm::distance(pieces_[piece].ends[entry], to.at);
      end = 1 - entry;
      length += glm::distance(pieces_[piece].ends[0], pieces_[piece].ends[1]);
    }
    return std::numeric_limits<double>::infinity();
  }

  const std::vector<FrontColumn::Piece>& pieces_;
  std::map<std::array<SurfaceVertexId, 2>, std::vector<std::size_t>> at_edge_;
};

/// The skin that a column shows between `high` and `low`, from the top, without what is seen through an open mouth: far
/// behind the skin above it and below it.
std::vector<SkinLine::Place> front_of(const FrontColumn& column, double x, double high, double low) {
  std::vector<SkinLine::Place> seen;
  for (int k = 0; high - k * step_down > low; ++k) {
    const double y = high - k * step_down;
    if (const auto at = column.at(y); at && at->is_skin) seen.push_back({at->piece, {x, y, at->z}});
  }
  const auto is_inside = [&](const SkinLine::Place& place) {
    double above = -std::numeric_limits<double>::infinity();
    double below = above;
    for (const SkinLine::Place& other : seen) {
      const double up = other.at.y - place.at.y;
      if (std::abs(up) > widest_opening) continue;
      if (up > 0.0) above = std::max(above, other.at.z);
      if (up < 0.0) below = std::max(below, other.at.z);
    }
    return place.at.z < std::min(above, below) - least_depth;
  };
  std::vector<SkinLine::Place> front;
  std::copy_if(seen.begin(), seen.end(), std::back_inserter(front), std::not_fn(is_inside));
  return front;
}

/// Places between `high` and `low` where lips may meet, from the top.
std::vector<SeenLips> lips_at(const FaceFront& front, double x, double high, double low) {
  const FrontColumn column = front.column(x);
  const SkinLine line(column.pieces());
  const std::vector<SkinLine::Place> skin = front_of(column, x, high, low);
  std::vector<SeenLips> found;
  for (std::size_t k = 1; k < skin.size(); ++k) {
    const double limit = std::max(least_way, least_detour * glm::distance(skin[k - 1].at, skin[k].at));
    if (line.way(skin[k - 1], skin[k], limit) <= limit) continue;
    const SeenSpot lower = *front.spot(column, skin[k].at);
    // The inside of an open mouth ends at both lips: they belong together.
    if (!found.empty() && found.back().upper.place.y - lower.place.y < widest_opening)
      found.back().lower = lower;
    else
      found.push_back({*front.spot(column, skin[k - 1].at), lower});
  }
  return found;
}

/// The lips farthest aside to which `from` leads.
SeenLips follow_lips(const FaceFront& front, const SeenLips& from, double step) {
  SeenLips last = from;
  for (double x = from.middle().x + step; std::abs(x) < FaceFront::half_width; x += step) {
    const double y = last.middle().y;
    const auto here = lips_at(front, x, last.upper.place.y + above_lips, last.lower.place.y - above_lips);
    const auto next = std::min_element(here.begin(), here.end(), [&](const SeenLips& a, const SeenLips& b) {
      return std::abs(a.middle().y - y) < std::abs(b.middle().y - y);
    });
    if (next == here.end() || std::abs(next->middle().y - y) > steepest_step) break;
    last = *next;
  }
  return last;
}

}  // namespace

std::optional<SeenMouth> find_seen_mouth(const FaceFront& front) {
  std::optional<SeenMouth> widest;
  for (const SeenLips& middle : lips_at(front, FaceFront::middle, mouth_top, mouth_bottom)) {
    const auto corner = [&](double side) {
      return follow_lips(front, follow_lips(front, middle, side * step_aside), side * fine_step_aside);
    };
    const SeenMouth mouth{middle, corner(1.0), corner(-1.0)};
    if (mouth.width() > (widest ? widest->width() : least_mouth_width)) widest = mouth;
  }
  return widest;
}

}  // namespace semblante

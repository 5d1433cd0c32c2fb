#include "core/anatomy/face_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>
#include <vector>

#include "core/tables/mpeg4.h"
#include "core/types/feature_point_id.h"
#include "core/types/places.h"

namespace semblante {
namespace {

/// Measured on 44 models by other people (heads, bodies, animals, robots): faces have 0.82 to 0.95, the others at most
/// 0.80, except one of three models of Suzanne, a monkey, with 0.85.
constexpr double least_likeness = 0.81;
/// The bound of search_leaning_face(), which tries more positions: there models without a face have at most 0.83, and
/// that monkey 0.85.
constexpr double least_likeness_leaning = 0.86;
/// The angle between two positions of search_leaning_face(), radians: a face that is half a step off is still found.
constexpr double roll_step = std::numbers::pi / 18.0;
constexpr int rolls = 6;  ///< to either side
/// The sine of the greatest angle between a fit and its start. Without this bound models without a face reach a greater
/// likeness.
constexpr double most_fitted_lean = 0.14;
/// By how many times the relief may be stronger or weaker than that of people.
constexpr double strongest = 2.0;
constexpr double weakest = 0.5;
/// The share of the feature points of a face at which something is seen.
constexpr double least_seen = 0.85;
/// ES0 as a part of the greater extent of what is seen: from that of a mask down to a 45th, of a body with a weapon.
constexpr double largest_face = 1.0 / 2.6;
constexpr double size_step = 1.09;
constexpr int sizes = 34;
// All lengths below are in ES0.
/// The top of what is seen above the middle between the eyes: of a mask, and of a tall hat.
constexpr double least_forehead = 0.5;
constexpr double greatest_forehead = 4.5;
constexpr double width_of_forehead = 0.75;  ///< to either side
/// By how much the tip of the nose at least stands out before the mean of the eyes and the corners of the mouth: a
/// quick test, which most places fail.
constexpr double least_nose = 0.10;
/// Depths farther than this from their median are seen through an opening, or beside the face.
constexpr double deepest = 1.2;
constexpr double step = 1.0 / 7.0;
/// The distance of the knots at which a face is compared.
constexpr double knots_of_search = 1.0 / 12.0;
constexpr double knots_of_fit = 1.0 / 16.0;
/// The best places of the search, of which each is fitted.
constexpr std::size_t fitted = 60;
constexpr double first_fit_step = 0.1;
constexpr double last_fit_step = 0.004;

/// A place of the front of a face, in the frame of the reference heads.
using FacePlace = glm::dvec3;

/// The mean places of the points of the lips, the eyes, the brows, the cheeks and the outside of the nose: not of the
/// jaw, which ends where the neck is seen.
std::vector<FacePlace> places_of_front(const Places& mean) {
  constexpr std::array<std::string_view, 6> of_front = {"2.", "3.", "4.", "5.", "8.", "9."};
  constexpr std::array<std::string_view, 9> not_seen = {"2.1", "2.11", "2.12", "2.13", "2.14",
                                                        "9.8", "9.9",  "9.10", "9.11"};
  std::vector<FacePlace> places;
  for (std::size_t id = 0; id < mean.size(); ++id) {
    const std::string_view name = mpeg4::feature_points[id].id;
    const bool is_of_front =
        std::any_of(of_front.begin(), of_front.end(), [&](std::string_view group) { return name.starts_with(group); });
    if (!mean[id] || !is_of_front || std::find(not_seen.begin(), not_seen.end(), name) != not_seen.end()) continue;
    places.push_back(*mean[id]);
  }
  return places;
}

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Subtracts from `values` what they have of a vector of length 1.
void subtract_share(std::span<double> values, std::span<const double> unit) {
  const double share = dot(values, unit);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= share * unit[i];
}

/// The upper median. Changes the order of the values.
double take_median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Candidate {
  double x = 0.0, y = 0.0;  ///< of the middle between the eyes
  double es0 = 0.0;
  glm::dvec2 left{1.0, 0.0};  ///< the direction of the face's left, a unit vector
  double likeness = -1.0;

  /// What is seen at a place of such a face.
  [[nodiscard]] double depth(const FrontRelief::Level& level, const FacePlace& place) const {
    return level.at(x + es0 * (place.x * left.x - place.y * left.y), y + es0 * (place.x * left.y + place.y * left.x));
  }
  /// `way` is in ES0.
  [[nodiscard]] Candidate moved_by(const glm::dvec2& way) const {
    Candidate moved = *this;
    moved.x += way.x * es0;
    moved.y += way.y * es0;
    return moved;
  }
  [[nodiscard]] Candidate grown_by(double share) const {
    Candidate grown = *this;
    grown.es0 *= 1.0 + share;
    return grown;
  }
  /// About the line of sight, in radians.
  [[nodiscard]] Candidate turned_by(double roll) const {
    Candidate turned = *this;
    turned.left = {left.x * std::cos(roll) - left.y * std::sin(roll),
                   left.y * std::cos(roll) + left.x * std::sin(roll)};
    return turned;
  }
};

class FaceSearch {
 public:
  FaceSearch(const FrontRelief& relief, std::span<const ReferenceHead> references) : relief_(relief) {
    const Places mean = mean_of(references);
    places_ = places_of_front(mean);
    const auto place = [&](std::string_view name) {
      return mean[parse_feature_point(name)->value()].value_or(FacePlace(0.0));
    };
    nose_ = place("9.3");
    around_nose_ = {place("3.5"), place("3.6"), place("8.3"), place("8.4")};
  }

  [[nodiscard]] std::optional<SeenFace> run() {
    const std::array upright = {0.0};
    return find(upright, least_likeness);
  }

  [[nodiscard]] std::optional<SeenFace> run_leaning() {
    std::vector<double> leaning;
    for (int n = 1; n <= rolls; ++n) leaning.insert(leaning.end(), {-n * roll_step, n * roll_step});
    return find(leaning, least_likeness_leaning);
  }

 private:
  [[nodiscard]] std::optional<SeenFace> find(std::span<const double> leans, double least) {
    const Candidate best = find_best(leans);
    return best.likeness < least ? std::nullopt : std::optional(seen_at(best));
  }

  [[nodiscard]] Candidate find_best(std::span<const double> leans) {
    Candidate best;
    for (const Candidate& candidate : search(leans)) {
      const Candidate fit = fit_from(candidate);
      if (fit.likeness > best.likeness) best = fit;
    }
    return best;
  }

  [[nodiscard]] SeenFace seen_at(const Candidate& c) {
    const glm::dmat3 to_relief({c.left.x, c.left.y, 0.0}, {-c.left.y, c.left.x, 0.0}, {0.0, 0.0, 1.0});
    look(relief_.with_step(knots_of_fit * c.es0), c);
    prepare_places();
    std::vector<double> off(seen_.size());
    for (std::size_t i = 0; i < off.size(); ++i) off[i] = seen_[i] - places_[which_[i]].z;
    std::vector<double> sorted = off;
    const double depth = take_median(sorted);
    for (double& z : off) z = std::clamp(z - depth, -deepest, deepest);
    SeenFace face;
    face.frame.scale = 1.0 / c.es0;
    face.frame.rotation = glm::transpose(to_relief);
    face.frame.from = {c.x, c.y, depth * c.es0};
    face.likeness = c.likeness;
    face.slopes = slopes_of(off);
    return face;
  }

  /// Of the plane that is fitted to depths at the places that were looked at last.
  [[nodiscard]] glm::dvec2 slopes_of(std::span<const double> depths) const {
    std::vector<double> x;
    std::vector<double> y;
    for (const std::size_t k : which_) {
      x.push_back(places_[k].x);
      y.push_back(places_[k].y);
    }
    const double along_y = dot(depths, slopes_[2]) / dot(y, slopes_[2]);
    const double along_x = (dot(depths, slopes_[1]) - along_y * dot(y, slopes_[1])) / dot(x, slopes_[1]);
    return {along_x, along_y};
  }

  /// The depths that are seen at the places of a face, in ES0.
  void look(const FrontRelief::Level& level, const Candidate& c) {
    seen_.clear();
    which_.clear();
    for (std::size_t k = 0; k < places_.size(); ++k) {
      const double z = c.depth(level, places_[k]);
      if (std::isnan(z)) continue;
      seen_.push_back(z / c.es0);
      which_.push_back(k);
    }
  }

  /// Gram-Schmidt: each of 1, x, y, x^2 and y^2 at the places that are seen, without what the ones before it have of
  /// it; and what the depths of the reference heads have beside these. Mostly all places are seen.
  void prepare_places() {
    if (prepared_ == which_) return;
    prepared_ = which_;
    expected_.clear();
    for (const std::size_t k : prepared_) expected_.push_back(places_[k].z);
    for (std::size_t n = 0; n < slopes_.size(); ++n) {
      std::vector<double>& slope = slopes_[n];
      slope.clear();
      for (const std::size_t k : prepared_) {
        const FacePlace& p = places_[k];
        slope.push_back(std::array{1.0, p.x, p.y, p.x * p.x, p.y * p.y}[n]);
      }
      for (std::size_t before = 0; before < n; ++before) subtract_share(slope, slopes_[before]);
      const double length = std::sqrt(dot(slope, slope));
      for (double& value : slope) value /= length;
      subtract_share(expected_, slope);
    }
  }

  /// The correlation of both depths beside slopes and curvature; -1 where too little is seen, or the relief is not as
  /// strong as a face's.
  [[nodiscard]] double likeness_at(const FrontRelief::Level& level, const Candidate& c) {
    if (!has_nose(level, c)) return -1.0;
    look(level, c);
    if (static_cast<double>(seen_.size()) < least_seen * static_cast<double>(places_.size())) return -1.0;
    prepare_places();
    sorted_ = seen_;
    const double middle = take_median(sorted_);
    for (double& z : seen_) z = std::clamp(z - middle, -deepest, deepest);
    for (const std::vector<double>& slope : slopes_) subtract_share(seen_, slope);
    const double together = dot(seen_, expected_);
    const double strength = together / dot(expected_, expected_);
    if (!(strength > weakest && strength < strongest)) return -1.0;
    return together / std::sqrt(dot(seen_, seen_) * dot(expected_, expected_));
  }

  [[nodiscard]] bool has_nose(const FrontRelief::Level& level, const Candidate& c) const {
    double sum = 0.0;
    int seen = 0;
    for (const FacePlace& place : around_nose_) {
      const double z = c.depth(level, place);
      if (std::isnan(z)) continue;
      sum += z;
      ++seen;
    }
    return seen > 0 && c.depth(level, nose_) - sum / seen > least_nose * c.es0;
  }

  /// The best places of all sizes, in no order.
  [[nodiscard]] std::vector<Candidate> search(std::span<const double> leans) {
    std::vector<Candidate> best;
    double es0 = largest_face * std::max(relief_.width(), relief_.height());
    for (int size = 0; size < sizes; ++size) {
      for (const double roll : leans) search_size(best, es0, roll);
      es0 /= size_step;
    }
    return best;
  }

  void search_size(std::vector<Candidate>& best, double es0, double roll) {
    const FrontRelief::Level& level = relief_.with_step(knots_of_search * es0);
    const glm::dvec2 left(std::cos(roll), std::sin(roll));
    const int columns = 1 + static_cast<int>(relief_.width() / (step * es0));
    constexpr int rows = static_cast<int>((greatest_forehead - least_forehead) / step);
    for (int column = 0; column < columns; ++column) {
      const double x = level.grid.origin.x + column * step * es0;
      const std::optional<double> top = top_at(level, x, es0);
      for (int row = 0; top && row < rows; ++row) {
        Candidate c{x, *top - (least_forehead + row * step) * es0, es0, left};
        c.likeness = likeness_at(level, c);
        if (c.likeness > 0.0) keep_best(best, c);
      }
    }
  }

  /// `best` is a heap with the worst on top.
  static void keep_best(std::vector<Candidate>& best, const Candidate& c) {
    const auto is_better = [](const Candidate& a, const Candidate& b) { return a.likeness > b.likeness; };
    if (best.size() == fitted) {
      if (c.likeness <= best.front().likeness) return;
      std::pop_heap(best.begin(), best.end(), is_better);
      best.pop_back();
    }
    best.push_back(c);
    std::push_heap(best.begin(), best.end(), is_better);
  }

  /// The highest place that is seen above a face at `x`.
  [[nodiscard]] static std::optional<double> top_at(const FrontRelief::Level& level, double x, double es0) {
    const FrontGrid& grid = level.grid;
    const int first = std::max(0, grid.column_at(x - width_of_forehead * es0));
    const int last = std::min(grid.columns - 1, grid.column_at(x + width_of_forehead * es0));
    for (int row = grid.rows - 1; row >= 0; --row) {
      for (int column = first; column <= last; ++column) {
        if (!std::isnan(level.z[grid.at(column, row)])) return grid.origin.y + row * grid.step;
      }
    }
    return std::nullopt;
  }

  /// Steps that grow smaller where none leads to a greater likeness.
  [[nodiscard]] Candidate fit_from(const Candidate& start) {
    const auto look_at = [&](Candidate c) {
      c.likeness = likeness_at(relief_.with_step(knots_of_fit * c.es0), c);
      return c;
    };
    Candidate best = look_at(start);
    double length = first_fit_step;
    while (length > last_fit_step) {
      bool is_better = false;
      for (const double way : {-length, length}) {
        for (const Candidate& c :
             {best.moved_by({way, 0.0}), best.moved_by({0.0, way}), best.grown_by(0.5 * way), best.turned_by(way)}) {
          const double lean = start.left.x * c.left.y - start.left.y * c.left.x;
          if (std::abs(lean) > most_fitted_lean) continue;
          const Candidate next = look_at(c);
          if (next.likeness <= best.likeness) continue;
          best = next;
          is_better = true;
        }
      }
      if (!is_better) length *= 0.5;
    }
    return best;
  }

  const FrontRelief& relief_;
  std::vector<FacePlace> places_;
  FacePlace nose_{0.0};
  std::array<FacePlace, 4> around_nose_{};
  // Buffers.
  std::vector<double> seen_;           ///< by look()
  std::vector<std::size_t> which_;     ///< of places_, as many as seen_
  std::vector<std::size_t> prepared_;  ///< those of the next two
  std::array<std::vector<double>, 5> slopes_;
  std::vector<double> expected_;
  std::vector<double> sorted_;
};

}  // namespace

std::optional<SeenFace> search_face(const FrontRelief& relief, std::span<const ReferenceHead> references) {
  return FaceSearch(relief, references).run();
}

std::optional<SeenFace> search_leaning_face(const FrontRelief& relief, std::span<const ReferenceHead> references) {
  return FaceSearch(relief, references).run_leaning();
}

}  // namespace semblante

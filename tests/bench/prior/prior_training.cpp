#include "tests/bench/prior/prior_training.h"

#include <algorithm>
#include <cmath>

#include <Eigen/SparseCore>
#include <glm/geometric.hpp>

#include "core/parametrize/smooth_weights.h"
#include "tests/bench/prior/minimize.h"

namespace semblante::bench {
namespace {

constexpr double table_ridge = 1e-5;
/// More, since offsets do not end where weights change their neighbours: less fits the own head better, others worse.
constexpr double offset_ridge = 3e-5;
constexpr double roughness_ridge = 1.0;
/// Against sums over one, which WeightPrior scales down.
constexpr double sum_penalty = 1e-3;
constexpr int iterations = 120;
/// Pairs of points that share less than this of the mean vertex say nothing; points that share less with either are no
/// targets.
constexpr double least_pair = 1e-4;
constexpr double least_target = 1e-5;

constexpr auto point_count = static_cast<Eigen::Index>(feature_point_count);
using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct Pair {
  std::size_t i, j;  ///< i < j; j may be root or an offset term
};

/// One head, reduced to what the fit needs.
struct Lesson {
  double weight;
  Matrix rows;                                                  ///< #skin x 84, without a prior
  std::vector<glm::dvec3> positions;                            ///< #skin, in ES0
  std::array<glm::dvec3, feature_point_count> point_positions;  ///< in ES0; of points that the head has
  Matrix gram;      ///< 84 x 84: sum over the expressions of the points' displacements, multiplied
  Matrix wanted;    ///< #skin x 84: the same with the vertex's displacement
  Matrix products;  ///< #skin x #pairs
  Eigen::SparseMatrix<float, Eigen::RowMajor> laplacian;  ///< #skin x #skin
};

Matrix rows_of(const ExpressionStudy& study) {
  const WeightTable<double> table = smooth_part_weights(study.surface, study.distances, study.eye_separation,
                                                        margin_sites(study.surface, study.distances.points), {});
  Matrix rows = Matrix::Zero(static_cast<Eigen::Index>(study.member_count()), point_count);
  for (std::size_t m = 0; m < study.member_count(); ++m) {
    for (std::size_t k = 0; k < table.points_of(m).size(); ++k) {
      rows(static_cast<Eigen::Index>(m), table.points_of(m)[k].value()) = static_cast<float>(table.weights_of(m)[k]);
    }
  }
  return rows;
}

Lesson lesson_of(const TrainingHead& head) {
  const ExpressionStudy& study = head.study;
  std::vector<Eigen::Index> skin(study.member_count(), -1);
  Eigen::Index count = 0;
  for (std::size_t m = 0; m < skin.size(); ++m) {
    if (!study.hidden[m]) skin[m] = count++;
  }
  Lesson lesson{head.weight,
                Matrix(count, point_count),
                {},
                {},
                Matrix::Zero(point_count, point_count),
                Matrix::Zero(count, point_count),
                {},
                {count, count}};
  const Matrix all = rows_of(study);
  const double unit = weight_unit(study.distances, study.eye_separation);
  for (std::size_t m = 0; m < skin.size(); ++m) {
    if (skin[m] < 0) continue;
    lesson.rows.row(skin[m]) = all.row(static_cast<Eigen::Index>(m));
    lesson.positions.push_back(study.position(m) / unit);
  }
  for (const SurfacePoint& point : study.distances.points)
    lesson.point_positions[point.id.value()] = point.position / unit;
  for (const Expression& expression : study.expressions) {
    double size = 0.0;
    for (const glm::dvec3& d : expression.displacement) size += glm::dot(d, d);
    const double scale = 1.0 / (size * static_cast<double>(study.expressions.size()));
    Eigen::Matrix<float, Eigen::Dynamic, 3> points = Eigen::Matrix<float, Eigen::Dynamic, 3>::Zero(point_count, 3);
    for (std::size_t p = 0; p < study.point_count(); ++p) {
      const glm::dvec3& d = expression.displacement[study.member_of_point[p]] * std::sqrt(scale);
      points.row(study.distances.points[p].id.value()) << static_cast<float>(d.x), static_cast<float>(d.y),
          static_cast<float>(d.z);
    }
    lesson.gram += points * points.transpose();
    Eigen::Matrix<float, Eigen::Dynamic, 3> truth(count, 3);
    for (std::size_t m = 0; m < skin.size(); ++m) {
      const glm::dvec3 d = expression.displacement[m] * std::sqrt(scale);
      if (skin[m] >= 0) truth.row(skin[m]) << static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z);
    }
    lesson.wanted += truth * points.transpose();
  }
  std::vector<Eigen::Triplet<float>> entries;
  for (const CotangentEdge& edge : cotangent_edges(study)) {
    const Eigen::Index a = skin[edge.a];
    const Eigen::Index b = skin[edge.b];
    if (a < 0 || b < 0) continue;
    const auto w = static_cast<float>(edge.weight);
    for (const auto& [r, c, v] :
         {std::tuple(a, b, w), std::tuple(b, a, w), std::tuple(a, a, -w), std::tuple(b, b, -w)}) {
      entries.emplace_back(static_cast<int>(r), static_cast<int>(c), v);
    }
  }
  lesson.laplacian.setFromTriplets(entries.begin(), entries.end());
  return lesson;
}

/// With the root's share as the last column.
Matrix with_root(const Matrix& rows) {
  Matrix all(rows.rows(), point_count + 1);
  all << rows, (1.0F - rows.rowwise().sum().array()).max(0.0F).matrix();
  return all;
}

class Fit {
 public:
  explicit Fit(std::span<const TrainingHead> heads) {
    for (const TrainingHead& head : heads) lessons_.push_back(lesson_of(head));
    choose_pairs();
    for (Lesson& lesson : lessons_) find_products(lesson);
  }

  std::vector<WeightPrior::Entry> solve() {
    const Eigen::Index size = mask_.size();
    const Eigen::VectorXd best =
        minimize([&](const Eigen::VectorXd& x, Eigen::VectorXd& slope) { return value_and_slope(x, slope); },
                 Eigen::VectorXd::Zero(size), iterations);
    const Matrix table = table_of(best);
    std::vector<WeightPrior::Entry> entries;
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      for (std::size_t k = 0; k < feature_point_count; ++k) {
        const auto hundredths = static_cast<std::int16_t>(
            std::lround(100.0F * table(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(k))));
        if (std::abs(hundredths) < least_hundredths) continue;
        const auto [i, j] = pairs_[p];
        const auto [mi, mj] = std::minmax({WeightPrior::mirrored(i), WeightPrior::mirrored(j)});
        if (std::tuple(mi, mj, WeightPrior::mirrored(k)) < std::tuple(i, j, k)) continue;  // the image stands for it
        entries.push_back(
            {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j), static_cast<std::uint8_t>(k), hundredths});
      }
    }
    return entries;
  }

 private:
  static constexpr int least_hundredths = 5;

  /// What each entry of the table is multiplied by at each vertex: the products of WeightPrior::correct.
  void find_products(Lesson& lesson) const {
    const Matrix all = with_root(lesson.rows);
    lesson.products.resize(all.rows(), static_cast<Eigen::Index>(pairs_.size()));
    std::vector<double> off_edges;
    for (Eigen::Index m = 0; m < all.rows(); ++m) {
      WeightRow row;
      for (std::size_t id = 0; id < feature_point_count; ++id)
        row.at(id) = lesson.rows(m, static_cast<Eigen::Index>(id));
      off_edges.push_back(WeightPrior::share_off_edges(row));
    }
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      const auto [i, j] = pairs_[p];
      auto column = lesson.products.col(static_cast<Eigen::Index>(p));
      column = all.col(static_cast<Eigen::Index>(i));
      if (j <= WeightPrior::root) column.array() *= all.col(static_cast<Eigen::Index>(j)).array();
      if (j == WeightPrior::root) column.array() *= 1.0F - all.col(point_count).array();
      if (j < WeightPrior::first_axis) continue;
      for (std::size_t m = 0; m < off_edges.size(); ++m) {
        const WeightPrior::OffsetTerms terms =
            WeightPrior::offset_terms(lesson.positions[m] - lesson.point_positions[i]);
        column(static_cast<Eigen::Index>(m)) *= static_cast<float>(terms[j - WeightPrior::first_axis] * off_edges[m]);
      }
    }
  }

  void choose_pairs() {
    Eigen::MatrixXd together = Eigen::MatrixXd::Zero(point_count + 1, point_count + 1);
    for (const Lesson& lesson : lessons_) {
      const Eigen::MatrixXd all = with_root(lesson.rows).cast<double>();
      together += all.transpose() * all / static_cast<double>(all.rows() * static_cast<Eigen::Index>(lessons_.size()));
    }
    // The table is symmetric.
    Eigen::MatrixXd both = together;
    for (Eigen::Index i = 0; i <= point_count; ++i) {
      for (Eigen::Index j = 0; j <= point_count; ++j) both(i, j) += together(mirror(i), mirror(j));
    }
    both /= 2.0;
    for (std::size_t i = 0; i <= feature_point_count; ++i) {
      for (std::size_t j = i + 1; j <= feature_point_count; ++j) {
        const double shared = both(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        if (shared > least_pair && WeightPrior::allows(i, j)) pairs_.push_back({i, j});
      }
    }
    for (std::size_t i = 0; i < feature_point_count; ++i) {
      for (std::size_t term = WeightPrior::first_axis; term < WeightPrior::column_count; ++term) {
        const double used = both(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i));
        if (used > least_pair && WeightPrior::allows(i, term)) pairs_.push_back({i, term});
      }
    }
    mask_ = Matrix::Zero(static_cast<Eigen::Index>(pairs_.size()), point_count);
    ridge_.resize(mask_.rows());
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      const bool is_offset = pairs_[p].j >= WeightPrior::first_axis;
      ridge_[static_cast<Eigen::Index>(p)] = static_cast<float>(is_offset ? offset_ridge : table_ridge);
      for (Eigen::Index k = 0; k < point_count; ++k) {
        for (const std::size_t of : {pairs_[p].i, pairs_[p].j}) {
          const bool near = of < WeightPrior::root && both(static_cast<Eigen::Index>(of), k) > least_target;
          if (near) mask_(static_cast<Eigen::Index>(p), k) = 1.0F;
        }
      }
    }
    for (const Pair& pair : pairs_) {
      const auto [i, j] = std::minmax({WeightPrior::mirrored(pair.i), WeightPrior::mirrored(pair.j)});
      const auto at =
          std::find_if(pairs_.begin(), pairs_.end(), [&, i = i, j = j](const Pair& p) { return p.i == i && p.j == j; });
      image_of_pair_.push_back(static_cast<Eigen::Index>(at - pairs_.begin()));
    }
  }

  static Eigen::Index mirror(Eigen::Index id) {
    return static_cast<Eigen::Index>(WeightPrior::mirrored(static_cast<std::size_t>(id)));
  }

  [[nodiscard]] Matrix symmetric(const Matrix& table) const {
    Matrix result(table.rows(), table.cols());
    for (Eigen::Index p = 0; p < table.rows(); ++p) {
      for (Eigen::Index k = 0; k < table.cols(); ++k) {
        const auto sign = static_cast<float>(WeightPrior::sign_of_image(pairs_[static_cast<std::size_t>(p)].j));
        result(p, k) = (table(p, k) + sign * table(image_of_pair_[static_cast<std::size_t>(p)], mirror(k))) / 2.0F;
      }
    }
    return result;
  }

  [[nodiscard]] Matrix table_of(const Eigen::VectorXd& x) const {
    const Matrix table = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
                             x.data(), mask_.rows(), mask_.cols())
                             .cast<float>();
    return symmetric(table.cwiseProduct(mask_));
  }

  double value_and_slope(const Eigen::VectorXd& x, Eigen::VectorXd& slope) const {
    const Matrix table = table_of(x);
    Matrix steep = 2.0F * ridge_.asDiagonal() * table;
    double value = table.cwiseProduct(steep).cast<double>().sum() / 2.0;
    for (const Lesson& lesson : lessons_) {
      const Matrix added = lesson.products * table;
      // As WeightPrior: added where it is positive, with a slope that falls from one to zero where it is negative.
      const Matrix rest = (added.array() < 0.0F).select(lesson.rows.array() / (lesson.rows - added).array(), 1.0F);
      const Matrix weights = lesson.rows.cwiseProduct(rest) + added.cwiseMax(0.0F);
      const Eigen::VectorXf over = (weights.rowwise().sum().array() - 1.0F).max(0.0F).matrix();
      const Matrix weighted = weights * lesson.gram;
      value += lesson.weight * (weights.cwiseProduct(weighted - 2.0F * lesson.wanted).cast<double>().sum() +
                                sum_penalty * over.cast<double>().squaredNorm());
      Matrix back = 2.0F * (weighted - lesson.wanted);
      back.colwise() += static_cast<float>(2.0 * sum_penalty) * over;
      back = back.cwiseProduct(rest.cwiseProduct(rest));
      const Matrix rough = lesson.laplacian * added;
      const Matrix rough_weighted = rough * lesson.gram;
      value += lesson.weight * roughness_ridge * rough.cwiseProduct(rough_weighted).cast<double>().sum();
      back += static_cast<float>(2.0 * roughness_ridge) * (lesson.laplacian.transpose() * rough_weighted);
      steep += static_cast<float>(lesson.weight) * (lesson.products.transpose() * back);
    }
    const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> masked =
        symmetric(steep).cwiseProduct(mask_).cast<double>();
    slope = Eigen::Map<const Eigen::VectorXd>(masked.data(), masked.size());
    return value;
  }

  std::vector<Lesson> lessons_;
  std::vector<Pair> pairs_;
  std::vector<Eigen::Index> image_of_pair_;
  Eigen::VectorXf ridge_;  ///< by pair
  Matrix mask_;            ///< #pairs x 84: 1 where the table may have an entry
};

}  // namespace

std::vector<WeightPrior::Entry> train_prior(std::span<const TrainingHead> heads) { return Fit(heads).solve(); }

}  // namespace semblante::bench

#include "tests/bench/bridges/ict_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <glm/geometric.hpp>

#include "core/parametrize/place_feature_points.h"
#include "core/tables/mpeg4.h"
#include "tests/oracle/real_heads.h"

namespace semblante::bench {
namespace {

/// Of neutral.obj: face, then head and neck; what follows are insides and loose parts.
constexpr std::uint32_t seen_skin = 11248;

Head ict_head(const std::filesystem::path& folder) {
  Head head{"ict-facekit", oracle::import_head(folder / "neutral.obj"), {}, {}};
  head.surface = build_surface(head.model);
  auto points = place_feature_points(head.model, head.surface,
                                     oracle::read_trusted_points(folder / "ict-facekit.fps.json"), nullptr);
  if (!points) throw std::runtime_error(points.error().message);
  head.points = *std::move(points);
  return head;
}

/// File name -> the coefficients that make it: a name without a side means both.
ArkitCoefficients coefficients_of(const std::string& file) {
  std::vector<std::string> names;
  if (file == "jawOpen_mouthClose") {
    names = {"jawOpen", "mouthClose"};
  } else if (file.ends_with("_L")) {
    names = {file.substr(0, file.size() - 2) + "Left"};
  } else if (file.ends_with("_R")) {
    names = {file.substr(0, file.size() - 2) + "Right"};
  } else if (find_arkit(file)) {
    names = {file};
  } else {
    names = {file + "Left", file + "Right"};
  }
  ArkitCoefficients coefficients{};
  for (const std::string& name : names) coefficients.at(find_arkit(name).value()) = 1.0F;
  return coefficients;
}

double dot_over(const std::vector<std::uint32_t>& vertices, const std::vector<glm::vec3>& a,
                const std::vector<glm::vec3>& b) {
  double sum = 0.0;
  for (const std::uint32_t v : vertices) sum += glm::dot(glm::dvec3(a[v]), glm::dvec3(b[v]));
  return sum;
}

double error_over(const std::vector<std::uint32_t>& vertices, const std::vector<glm::vec3>& ours,
                  const std::vector<glm::vec3>& theirs) {
  double wrong = 0.0;
  for (const std::uint32_t v : vertices) {
    const glm::dvec3 d = glm::dvec3(ours[v]) - glm::dvec3(theirs[v]);
    wrong += glm::dot(d, d);
  }
  return std::sqrt(wrong / dot_over(vertices, theirs, theirs));
}

}  // namespace

IctStudy::IctStudy(const std::filesystem::path& folder) : head(ict_head(folder)), face(head, WeightMethod::smooth) {
  for (std::uint32_t v = 0; v < seen_skin; ++v) skin.push_back(v);
  for (const FeaturePoint& point : head.points) {
    if (point.vertex && point.vertex->value() < seen_skin) points.push_back(point.vertex->value());
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "expressions")) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files) {
    const Model moved = oracle::read_trusted_obj(file);
    IctShape shape{file.stem().string(), coefficients_of(file.stem().string()), {}};
    for (std::size_t v = 0; v < head.model.positions.size(); ++v) {
      shape.displacement.push_back(moved.positions.at(v) - head.model.positions[v]);
    }
    shapes.push_back(std::move(shape));
  }
}

std::vector<glm::vec3> IctStudy::displacement_of(const semblante_frame& frame) const {
  std::vector<glm::vec3> moved = face.pose(frame);
  for (std::size_t v = 0; v < moved.size(); ++v) moved[v] -= head.model.positions[v];
  return moved;
}

BridgeQuality compare(const IctStudy& study, const std::vector<glm::vec3>& ours, const std::vector<glm::vec3>& theirs) {
  BridgeQuality quality;
  quality.error = error_over(study.skin, ours, theirs);
  quality.cosine = dot_over(study.skin, ours, theirs) /
                   std::sqrt(dot_over(study.skin, ours, ours) * dot_over(study.skin, theirs, theirs));
  quality.point_error = error_over(study.points, ours, theirs);
  return quality;
}

semblante_frame nearest_faps(const IctStudy& study, const IctShape& shape, const semblante_frame& start, double pull) {
  struct Column {
    std::size_t fap;
    std::vector<glm::vec3> displacement;  // of one unit
  };
  static const std::vector<Column> columns = [&] {
    std::vector<Column> result;
    for (const mpeg4::Fap& fap : mpeg4::faps) {
      if (fap.kind != mpeg4::FapKind::translation || fap.group == 6) continue;
      Column column{fap.number, study.displacement_of(frame_of({{fap.number, 100.0F}}))};
      for (glm::vec3& d : column.displacement) d /= 100.0F;
      if (dot_over(study.skin, column.displacement, column.displacement) > 0.0) result.push_back(std::move(column));
    }
    return result;
  }();
  static const std::vector<std::vector<double>> gram = [&] {
    std::vector<std::vector<double>> result(columns.size(), std::vector<double>(columns.size()));
    for (std::size_t a = 0; a < columns.size(); ++a) {
      for (std::size_t b = 0; b < columns.size(); ++b) {
        result[a][b] = dot_over(study.skin, columns[a].displacement, columns[b].displacement);
      }
    }
    return result;
  }();
  std::vector<double> x(columns.size());
  std::vector<double> slope(columns.size());
  for (std::size_t a = 0; a < columns.size(); ++a) {
    x[a] = start.fap[columns[a].fap];
    slope[a] = -dot_over(study.skin, columns[a].displacement, shape.displacement);
  }
  for (std::size_t a = 0; a < columns.size(); ++a) {
    for (std::size_t b = 0; b < columns.size(); ++b) slope[a] += gram[a][b] * x[b];
  }
  for (int sweep = 0; sweep < 3000; ++sweep) {
    for (std::size_t a = 0; a < columns.size(); ++a) {
      const mpeg4::Fap& fap = mpeg4::fap(columns[a].fap);
      const double drawn = pull * gram[a][a] * (x[a] - start.fap[columns[a].fap]);
      const double wanted = x[a] - (slope[a] + drawn) / (gram[a][a] * (1.0 + pull));
      const double step = std::clamp(wanted, 1.0 * fap.min(), 1.0 * fap.max()) - x[a];
      x[a] += step;
      for (std::size_t b = 0; b < columns.size(); ++b) slope[b] += step * gram[a][b];
    }
  }
  semblante_frame frame{};
  for (std::size_t a = 0; a < columns.size(); ++a) frame.fap[columns[a].fap] = static_cast<float>(x[a]);
  return frame;
}

}  // namespace semblante::bench

#include "tests/bench/prior/training_head.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <random>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "tests/oracle/real_heads.h"

namespace semblante::bench {
namespace {

/// The data of a NumPy file of little-endian int16 in C order.
std::vector<std::int16_t> read_int16_array(const std::filesystem::path& file, std::size_t count) {
  std::ifstream in(file, std::ios::binary);
  std::array<char, 10> start{};
  if (!in.read(start.data(), start.size()) || std::string(start.data(), 6) != "\x93NUMPY" || start[6] != 1) {
    throw std::runtime_error(file.string() + " is not a NumPy file of version 1");
  }
  const auto header_size = static_cast<std::size_t>(static_cast<unsigned char>(start[8])) |
                           static_cast<std::size_t>(static_cast<unsigned char>(start[9])) << 8U;
  std::string header(header_size, '\0');
  in.read(header.data(), static_cast<std::streamsize>(header_size));
  if (header.find("'<i2'") == std::string::npos || header.find("'fortran_order': False") == std::string::npos) {
    throw std::runtime_error(file.string() + " does not hold little-endian int16 in C order");
  }
  std::vector<std::int16_t> values(count);
  if (!in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(2 * count))) {
    throw std::runtime_error(file.string() + " is too short");
  }
  return values;
}

}  // namespace

glm::dvec3 ShapeFile::at(std::size_t shape, std::uint32_t vertex) const {
  const std::int16_t* const v = &values[(shape * vertex_count + vertex) * 3];
  return glm::dvec3(v[0], v[1], v[2]) * scale;
}

ShapeFile read_shapes(const std::filesystem::path& folder, const std::string& kind) {
  constexpr std::size_t vertices = 26719;
  const nlohmann::json all = nlohmann::json::parse(std::ifstream(folder / "shapes.json"));
  const nlohmann::json& about = all.at(kind);
  ShapeFile shapes;
  shapes.names = about.at("names").get<std::vector<std::string>>();
  shapes.scale = about.at("scale").get<double>();
  shapes.vertex_count = vertices;
  shapes.values =
      read_int16_array(folder / about.at("file").get<std::string>(), shapes.names.size() * shapes.vertex_count * 3);
  return shapes;
}

ExpressionStudy read_ict_shapes(const std::filesystem::path& folder, std::uint32_t identity,
                                const std::function<bool(const std::string&)>& wanted) {
  Model model = oracle::import_head(folder / "neutral.obj");
  if (identity > 0) {
    const ShapeFile modes = read_shapes(folder, "identities");
    std::mt19937 random(identity);
    for (std::size_t mode = 0; mode < modes.names.size(); ++mode) {
      // Sums of uniform numbers: the same people with every standard library.
      double coefficient = -6.0;
      for (int k = 0; k < 12; ++k) coefficient += static_cast<double>(random()) / 4294967296.0;
      for (std::uint32_t v = 0; v < model.positions.size(); ++v) {
        model.positions[v] += glm::vec3(coefficient * modes.at(mode, v));
      }
    }
  }
  std::vector<MarkedPoint> points = oracle::read_trusted_points(folder / "ict-facekit.fps.json");
  for (MarkedPoint& point : points) {
    if (point.vertex) point.position = glm::dvec3(model.positions[*point.vertex]);
  }
  ExpressionStudy study = study_of(std::move(model), points);
  const ShapeFile shapes = read_shapes(folder, "expressions");
  for (std::size_t s = 0; s < shapes.names.size(); ++s) {
    if (!wanted(shapes.names[s])) continue;
    study.expressions.push_back(
        expression_of(study, shapes.names[s], [&](std::uint32_t v) { return shapes.at(s, v); }));
  }
  return study;
}

bool is_measured(const std::string& shape) {
  constexpr std::array<const char*, 13> used = {
      "browDown",    "browInnerUp",    "eyeBlink",   "eyeWide",     "jawOpen",    "mouthClose", "mouthFrown",
      "mouthFunnel", "mouthLowerDown", "mouthPress", "mouthPucker", "mouthSmile", "noseSneer"};
  return std::any_of(used.begin(), used.end(), [&](const char* name) { return shape.starts_with(name); });
}

}  // namespace semblante::bench

#include "tests/oracle/real_heads.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

#include "core/import/import.h"

namespace semblante::oracle {

std::optional<std::filesystem::path> faces_folder() {
  const char* const named = std::getenv("SEMBLANTE_FACES_DIR");
  const std::filesystem::path folder =
      named != nullptr && *named != '\0' ? named : std::filesystem::path(SEMBLANTE_SOURCE_DIR) / "../shared/faces";
  for (const char* const head : {"ict-facekit", "makehuman", "mediapipe-canonical"}) {
    if (!std::filesystem::is_directory(folder / head)) return std::nullopt;
  }
  return folder;
}

Model read_trusted_obj(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  Model model;
  model.format = "obj";
  std::string line;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::string word;
    if (!(words >> word)) continue;
    if (word == "v") {
      glm::vec3 p;
      words >> p.x >> p.y >> p.z;
      model.positions.push_back(p);
    } else if (word == "g" || word == "usemtl") {
      Primitive primitive;
      words >> primitive.name;
      primitive.first_triangle = static_cast<std::uint32_t>(model.triangles.size());
      model.primitives.push_back(primitive);
    } else if (word == "f") {
      std::vector<std::uint32_t> corners;
      while (words >> word) corners.push_back(static_cast<std::uint32_t>(std::stoul(word) - 1));
      if (model.primitives.empty()) model.primitives.emplace_back();
      for (std::size_t c = 2; c < corners.size(); ++c) {
        model.triangles.push_back({corners[0], corners[c - 1], corners[c]});
        ++model.primitives.back().triangle_count;
      }
    }
  }
  return model;
}

Model import_head(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(in), {}};
  const auto format = detect_format(bytes, file.filename().string());
  if (!format) throw std::runtime_error("cannot tell the format of " + file.string());
  Result<Model> model = import_model(bytes, *format);
  if (!model) throw std::runtime_error(file.string() + ": " + model.error().message);
  return *std::move(model);
}

void replace_positions(Model& model, const std::filesystem::path& file) {
  std::ifstream in(file);
  std::size_t vertex = 0;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind != "v" || vertex == model.positions.size()) continue;
    glm::vec3& p = model.positions[vertex++];
    words >> p.x >> p.y >> p.z;
  }
  if (vertex != model.positions.size()) throw std::runtime_error(file.string() + " belongs to another model");
}

std::vector<MarkedPoint> read_trusted_points(const std::filesystem::path& file) {
  const nlohmann::json document = nlohmann::json::parse(std::ifstream(file));
  std::vector<MarkedPoint> points;
  for (const auto& [name, entry] : document.at("points").items()) {
    MarkedPoint point;
    point.id = parse_feature_point(name).value();
    if (!entry.at("vertex").is_null()) point.vertex = entry.at("vertex").get<std::uint32_t>();
    const auto p = entry.at("position").get<std::array<double, 3>>();
    point.position = glm::dvec3(p[0], p[1], p[2]);
    points.push_back(point);
  }
  return points;
}

}  // namespace semblante::oracle

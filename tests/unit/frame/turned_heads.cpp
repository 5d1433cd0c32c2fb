#include "tests/unit/frame/turned_heads.h"

#include <glm/matrix.hpp>

#include "core/import/axes.h"
#include "core/import/import.h"
#include "deploy/sample_head/write_sample_head.h"
#include "tests/oracle/real_heads.h"

namespace semblante::test {
namespace {

std::vector<PlacedPoint> placed(const Model& model, const std::vector<MarkedPoint>& marked) {
  std::vector<PlacedPoint> points;
  for (const MarkedPoint& point : marked) {
    points.push_back({point.id, point.vertex ? glm::dvec3(model.positions[*point.vertex]) : *point.position});
  }
  return points;
}

}  // namespace

std::vector<Head> upright_heads() {
  std::vector<Head> heads;
  const SampleHead sample = make_sample_head();
  const auto glb = sample_head_glb(sample);
  auto model = import_model(*glb, ModelFormat::glb);
  heads.push_back({"sample", std::move(*model), {}});
  const auto json = sample_head_feature_points_json(sample);
  heads.back().points = placed(heads.back().model, parse_feature_points(json)->points);
  const auto faces = oracle::faces_folder();
  if (!faces) return heads;
  const auto add = [&](const char* name, const char* file, const char* points) {
    Model head = oracle::import_head(*faces / file);
    auto known =
        points == nullptr ? std::vector<PlacedPoint>{} : placed(head, oracle::read_trusted_points(*faces / points));
    heads.push_back({name, std::move(head), std::move(known)});
  };
  add("ict-facekit", "ict-facekit/neutral.obj", "ict-facekit/ict-facekit.fps.json");
  add("makehuman obj", "makehuman/head.obj", "makehuman/makehuman.fps.json");
  add("makehuman glb", "makehuman/head.glb", nullptr);
  add("mediapipe", "mediapipe-canonical/face_model_with_iris.obj", "mediapipe-canonical/mediapipe-canonical.fps.json");
  return heads;
}

Model turned(Model model, const Axes& axes) {
  change_axes(model, glm::transpose(to_mpeg4(axes)));
  model.to_file_frame = glm::mat4(1.0F);
  return model;
}

std::vector<PlacedPoint> turned(std::vector<PlacedPoint> points, const Axes& axes) {
  for (PlacedPoint& point : points) point.position = glm::transpose(to_mpeg4(axes)) * point.position;
  return points;
}

}  // namespace semblante::test

#include "server/report/levels_json.h"

#include <nlohmann/json.hpp>

namespace semblante {
namespace {

using Json = nlohmann::ordered_json;

Json to_value(const SurfaceError& error, double eye_separation) {
  Json json = {{"max", error.max}, {"mean", error.mean}, {"rms", error.rms}, {"of_es0", nullptr}};
  if (eye_separation > 0.0)
    json["of_es0"] = {{"max", error.max / eye_separation},
                      {"mean", error.mean / eye_separation},
                      {"rms", error.rms / eye_separation}};
  return json;
}

}  // namespace

nlohmann::ordered_json levels_of_detail_json(std::span<const LevelOfDetail> levels, std::span<const LevelError> errors,
                                             std::span<const LodPose> poses, double eye_separation,
                                             std::span<const MissedBudget> missed) {
  Json json;
  json["es0"] = eye_separation > 0.0 ? Json(eye_separation) : Json(nullptr);
  auto& list = json["levels"] = Json::array();
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const LevelError& error = errors[i];
    Json item = {{"lod", i + 1},
                 {"budget", levels[i].budget},
                 {"vertices", levels[i].vertex_count},
                 {"triangles", levels[i].triangles.size()},
                 {"neutral", to_value(error.neutral, eye_separation)},
                 {"expressions", Json::object()},
                 {"uv", {{"max", error.uv_max}, {"mean", error.uv_mean}}},
                 {"flipped_triangles", error.flipped_triangles},
                 {"flipped_uvs", error.flipped_uvs}};
    for (std::size_t pose = 0; pose < poses.size(); ++pose)
      item["expressions"][poses[pose].name] = to_value(error.poses[pose], eye_separation);
    list.push_back(std::move(item));
  }
  auto& misses = json["missed"] = Json::array();
  for (const MissedBudget& miss : missed) misses.push_back({{"budget", miss.budget}, {"words", miss.words}});
  return json;
}

}  // namespace semblante

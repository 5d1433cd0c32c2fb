#include "server/report/fit_json.h"

#include <nlohmann/json.hpp>

namespace semblante {

nlohmann::ordered_json weight_fit_json(const WeightFit& fit) {
  using Json = nlohmann::ordered_json;
  Json json = {{"error", fit.error()}, {"smooth_error", fit.smooth_error()}, {"shapes", Json::array()}};
  for (const ShapeError& shape : fit.shapes) {
    const auto share = [&](double wrong) { return shape.moved > 0.0 ? Json(wrong / shape.moved) : Json(nullptr); };
    json["shapes"].push_back(
        {{"name", shape.name}, {"error", share(shape.wrong)}, {"smooth_error", share(shape.smooth_wrong)}});
  }
  json["ignored"] = fit.ignored;
  return json;
}

}  // namespace semblante

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "core/anatomy/point_lookup.h"
#include "core/anatomy/rim_sides.h"
#include "core/frame/frame_guess.h"
#include "core/json/json_pointer.h"
#include "core/parametrize/fapu.h"
#include "core/propose/propose.h"
#include "core/types/feature_point_id.h"
#include "server/api/common.h"
#include "server/api/generated/body_members.h"
#include "server/api/generated/handlers.h"
#include "server/api/mirror_points.h"
#include "server/api/vertex_positions.h"
#include "server/http/conditional.h"

namespace semblante::api {
namespace {

constexpr std::size_t max_faults = 32;
constexpr std::size_t max_remark = 500;  ///< of a proposal, bytes

template <std::size_t N>
bool is_one_of(const JsonBody& value, const std::array<std::string_view, N>& names) {
  return value.is_string() && std::find(names.begin(), names.end(), value.get<std::string>()) != names.end();
}

/// Reads one entry of "points"; adds its errors to `faults`. `turn`: from the axes of its position to the model's.
std::optional<store::FeaturePointRecord> read_point(const std::string& id, const JsonBody& value,
                                                    std::uint32_t vertices, const std::optional<glm::dmat3>& turn,
                                                    std::vector<http::Fault>& faults) {
  const auto at = std::string("/points/").append(pointer_segment(id));
  const auto fault = [&](const std::string& where, std::string detail) {
    faults.push_back({at + where, std::move(detail)});
    return std::nullopt;
  };
  if (!parse_feature_point(id)) return fault("", "\"" + id + "\" is none of the 84 feature points");
  if (!value.is_object()) return fault("", "it must be an object with a vertex, a position or both");
  store::FeaturePointRecord point{id, std::nullopt, std::nullopt};
  if (value.contains("vertex") && !value["vertex"].is_null()) {
    const auto& vertex = value["vertex"];
    if (!vertex.is_number_integer()) return fault("/vertex", "it must be a whole number");
    if (!vertex.is_number_unsigned() || vertex.get<std::uint64_t>() >= vertices)
      return fault("/vertex", "vertex " + vertex.dump() + " is not there: the model has the vertices 0 to " +
                                  std::to_string(vertices - 1));
    point.vertex = vertex.get<std::uint32_t>();
  }
  if (value.contains("position") && !value["position"].is_null()) {
    const auto& position = value["position"];
    if (!position.is_array() || position.size() != 3) return fault("/position", "it must be three numbers");
    glm::dvec3 xyz(0.0);
    for (int i = 0; i < 3; ++i) {
      if (!position[i].is_number()) return fault("/position/" + std::to_string(i), "it must be a number");
      xyz[i] = position[i].get<double>();
    }
    if (turn) xyz = *turn * xyz;
    for (int i = 0; i < 3; ++i) {
      if (!std::isfinite(xyz[i]) || std::abs(xyz[i]) > 3e38)
        return fault("/position/" + std::to_string(i), "it is not a finite coordinate");
    }
    point.position = {xyz.x, xyz.y, xyz.z};
  }
  if (!point.vertex && !point.position) return fault("", "it has neither a vertex nor a position");
  const bool says = value.contains("proposed") && !value["proposed"].is_null();
  if (says && !value["proposed"].is_boolean()) return fault("/proposed", "it must be true or false");
  if (says && value["proposed"].get<bool>()) {
    auto& proposal = point.proposal.emplace();
    // For a placed point these members are ignored.
    if (value.contains("method")) {
      if (!is_one_of(value["method"], proposal_method_names))
        return fault("/method", "it is not a method of proposing a point");
      proposal.method = value["method"].get<std::string>();
    }
    if (value.contains("confidence")) {
      if (!is_one_of(value["confidence"], confidence_names))
        return fault("/confidence", "it must be \"high\", \"medium\" or \"low\"");
      proposal.confidence = value["confidence"].get<std::string>();
    }
    if (value.contains("expected_error")) {
      const auto& error = value["expected_error"];
      if (!error.is_number() || !(error.get<double>() >= 0.0) || !std::isfinite(error.get<double>()))
        return fault("/expected_error", "it must be a number, in ES0, not below 0");
      proposal.expected_error = error.get<double>();
    }
    if (value.contains("remark")) {
      if (!value["remark"].is_string() || value["remark"].get_ref<const std::string&>().size() > max_remark)
        return fault("/remark", "it must be a string of at most " + std::to_string(max_remark) + " bytes");
      proposal.remark = value["remark"].get<std::string>();
    }
  }
  return point;
}

/// Reads "points" into `points`: replaces those that are given and, where `removes`, removes those that are null.
void read_points(const JsonBody& body, std::uint32_t vertices, bool removes, const std::optional<glm::dmat3>& turn,
                 std::vector<store::FeaturePointRecord>& points) {
  if (!body["points"].is_object()) refuse("invalid-field", "it must be an object", "/points");
  std::vector<http::Fault> faults;
  for (const auto& [id, value] : body["points"].items()) {
    const bool is_removed = removes && value.is_null() && parse_feature_point(id);
    auto point = is_removed ? std::nullopt : read_point(id, value, vertices, turn, faults);
    if (faults.size() == max_faults) break;
    std::erase_if(points, [&id = id](const auto& p) { return p.id == id; });
    if (point) points.push_back(std::move(*point));
  }
  if (!faults.empty()) {
    auto problem = http::make_problem("invalid-feature-point", faults.front().detail, faults.front().pointer);
    if (faults.size() > 1) problem.faults = std::move(faults);
    throw Refused{std::move(problem)};
  }
  std::sort(points.begin(), points.end(),
            [](const auto& a, const auto& b) { return *parse_feature_point(a.id) < *parse_feature_point(b.id); });
}

/// A file of feature points that states its axes ("to_mpeg4_axes") has its positions in those of the model's file: the
/// rotation from them to the model's, empty if it states none. The stated axes are not used, because the points show
/// how the head stands.
std::optional<glm::dmat3> turn_of_positions(const JsonBody& body, const store::ModelRecord& model) {
  if (!body.contains("to_mpeg4_axes") || body["to_mpeg4_axes"].is_null()) return std::nullopt;
  const auto& rows = body["to_mpeg4_axes"];
  const auto is_row = [](const JsonBody& row) {
    return row.is_array() && row.size() == 3 &&
           std::all_of(row.begin(), row.end(), [](const JsonBody& number) { return number.is_number(); });
  };
  if (!rows.is_array() || rows.size() != 3 || !std::all_of(rows.begin(), rows.end(), is_row))
    refuse("invalid-field", "it must have 3 rows of 3 numbers", "/to_mpeg4_axes");
  glm::dmat3 axes(0.0);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) axes[column][row] = rows[row][column].get<double>();
  }
  if (!(glm::determinant(axes) > 0.0))
    refuse("invalid-field", "it mirrors the model or has no inverse, which is not accepted", "/to_mpeg4_axes");
  return model.frame ? turn_upright(*model.frame) : glm::dmat3(1.0);
}

/// A file of feature points may state the base of its vertex indices. The server does not convert them: it refuses
/// another base, instead of making a wrong face without notice.
void refuse_other_base(const JsonBody& body) {
  if (body.contains("vertex_index_base") && body["vertex_index_base"] != 0)
    refuse("invalid-field", "it must be 0: vertices count from 0", "/vertex_index_base");
}

/// A marked point with the position of its vertex, or with the vertex at its position if that is unambiguous.
answer::FeaturePoints::PointsValue represent_point(const store::FeaturePointRecord& point,
                                                   const VertexPositions& positions) {
  auto vertex = point.vertex;
  // On touching lips either vertex could be meant: a client that sends the answer back must not choose one by chance.
  const bool on_rim = rim_of_point(*parse_feature_point(point.id)).opening != nullptr;
  if (!vertex && point.position && !is_pupil(*parse_feature_point(point.id)))
    vertex = on_rim ? positions.only_one_at(*point.position) : positions.at(*point.position);
  answer::FeaturePoints::PointsValue value{.vertex = vertex, .position = point.position};
  if (!point.position) value.position = positions.of(*point.vertex);
  if (!point.proposal) return value;
  const auto& proposal = *point.proposal;
  value.proposed = true;
  if (!proposal.method.empty()) value.method = proposal.method;
  if (!proposal.confidence.empty()) value.confidence = proposal.confidence;
  if (proposal.expected_error > 0.0) value.expected_error = proposal.expected_error;
  if (!proposal.remark.empty()) value.remark = proposal.remark;
  return value;
}

/// Reads "fapu", lengths by name, into `lengths`: null removes all of them and, where `removes`, as a value one.
void read_fapu(const JsonBody& fapu, bool removes, store::FapuByUser& lengths) {
  if (fapu.is_null()) return lengths.clear();
  if (!fapu.is_object()) refuse("invalid-field", "it must be an object of lengths by unit", "/fapu");
  for (const auto& [name, value] : fapu.items()) {
    const auto at = std::string("/fapu/").append(pointer_segment(name));
    const bool is_removed = removes && value.is_null();
    if (!is_removed && !value.is_number()) refuse("invalid-field", "it must be a number", at);
    const double length = is_removed ? 1.0 : value.get<double>();
    if (const auto checked = fapu_from_lengths({{name, length}}); !checked)
      refuse("invalid-field", checked.error().message, at);
    if (is_removed)
      lengths.erase(name);
    else
      lengths[name] = length;
  }
}

http::Response represent_points(Context& context, const store::ModelRecord& model) {
  const VertexPositions positions(context, model);
  answer::FeaturePoints answer{.model = model.id, .fapu = {}, .points = {}};
  answer.fapu.assign(model.fapu.begin(), model.fapu.end());
  for (const auto& point : context.store.feature_points(model.id))
    answer.points.emplace_back(point.id, represent_point(point, positions));
  auto response = json_response(200, answer);
  response.headers["ETag"] = points_etag(model);
  return response;
}

/// The model of the request, whose points may be changed now.
store::ModelRecord editable_model(Context& context, http::Request& request) {
  auto model = model_of(context, request);
  if (model.state == store::ModelState::importing)
    refuse("conflict", "the model is still being imported: its vertices are not known yet");
  if (model.state == store::ModelState::failed) refuse("conflict", "the import of this model failed");
  check_if_match(request, points_etag(model));
  return model;
}

/// Stores what was read for `model`, if nobody changed its points in the meantime.
http::Response store_points(Context& context, http::Request& request, const store::ModelRecord& model,
                            const std::vector<store::FeaturePointRecord>& points,
                            const std::optional<store::FapuByUser>& fapu) {
  if (!context.store.put_points_and_fapu(model.id, points, fapu, model.feature_points_revision))
    refuse("conflict", "another request changed the points at the same time: read them and try again");
  return represent_points(context, model_of(context, request));
}

}  // namespace

http::Response get_feature_points(Context& context, http::Request& request) {
  return http::apply_preconditions(request, represent_points(context, model_of(context, request)));
}

http::Response put_feature_points(Context& context, http::Request& request) {
  const auto model = editable_model(context, request);
  const auto body = body_object(request);
  refuse_other_base(body);
  if (!body.contains("points")) refuse("invalid-field", "the field \"points\" is missing", "/points");
  std::vector<store::FeaturePointRecord> points;
  read_points(body, model.vertices, false, turn_of_positions(body, model), points);
  std::optional<store::FapuByUser> fapu;  // of a client that does not know them they stay as they are
  if (body.contains("fapu")) read_fapu(body["fapu"], false, fapu.emplace());
  if (const auto fill = request.query_value("fill")) {
    if (*fill != "mirror") refuse("invalid-argument", "the only way to fill is \"mirror\"", "?fill");
    fill_by_mirror(points, VertexPositions(context, model));
  }
  return store_points(context, request, model, points, fapu);
}

http::Response patch_feature_points(Context& context, http::Request& request) {
  const auto model = editable_model(context, request);
  const auto body = body_object(request);
  refuse_unknown_members(body, body_members::feature_points_edit);
  auto points = context.store.feature_points(model.id);
  if (body.contains("points")) read_points(body, model.vertices, true, std::nullopt, points);
  std::optional<store::FapuByUser> fapu;
  if (body.contains("fapu")) read_fapu(body["fapu"], true, fapu.emplace(model.fapu));
  return store_points(context, request, model, points, fapu);
}

}  // namespace semblante::api

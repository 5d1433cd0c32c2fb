#include "core/parametrize/parametrize.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include <glm/geometric.hpp>

#include "core/anatomy/iris.h"
#include "core/anatomy/joined_rims.h"
#include "core/anatomy/lids.h"
#include "core/anatomy/lip_gaps.h"
#include "core/anatomy/modelled_eye.h"
#include "core/anatomy/neck.h"
#include "core/anatomy/neck_folds.h"
#include "core/anatomy/part_roles.h"
#include "core/anatomy/pivots.h"
#include "core/anatomy/plausible_joints.h"
#include "core/anatomy/point_lookup.h"
#include "core/anatomy/tongue_shape.h"
#include "core/geometry/unfolded_surface.h"
#include "core/parametrize/coarse_lids.h"
#include "core/parametrize/fapu.h"
#include "core/parametrize/influence.h"
#include "core/parametrize/own_shapes.h"

namespace semblante {
namespace {

void warn_of_points(const Surface& surface, const std::vector<SurfacePoint>& points,
                    std::vector<std::string>& warnings) {
  if (points.empty()) warnings.emplace_back("no feature point is marked on the surface; nothing will move");
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (surface.steps_from(points[i].vertex).empty()) {
      warnings.push_back("point " + to_string(points[i].id) +
                         " is at a vertex that no triangle uses; it moves nothing");
    }
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      if (points[i].vertex != points[j].vertex) continue;
      warnings.push_back("points " + to_string(points[i].id) + " and " + to_string(points[j].id) +
                         " are at the same place; that vertex follows the mean of both");
    }
  }
}

void warn_of_closed_eyes(const Fapu& fapu, std::vector<std::string>& warnings) {
  if (fapu.origin[static_cast<std::size_t>(FapuUnit::irisd)] != FapuOrigin::closed_eyes) return;
  warnings.push_back("the eyes are closed: ES0 is the distance between the centres of the lids' corners, and IRISD0 " +
                     std::to_string(std::lround(100.0 * iris_share)) + " % of it; both can be given by hand");
}

void warn_of_parts(const std::vector<Part>& parts, const FeaturePointSet& points, std::vector<std::string>& warnings) {
  if (find_point(points, "2.1") == nullptr &&
      (has_part(parts, PartRole::lower_teeth) || has_part(parts, PartRole::tongue))) {
    warnings.emplace_back("2.1 is not marked; lower teeth and tongue do not follow the jaw");
  }
  if (!has_part(parts, PartRole::left_eye)) {
    warnings.emplace_back("no part is the left eye; FAPs 23, 25 and 27 turn nothing");
  }
  if (!has_part(parts, PartRole::right_eye)) {
    warnings.emplace_back("no part is the right eye; FAPs 24, 26 and 28 turn nothing");
  }
  if (find_point(points, "7.1") == nullptr) {
    warnings.emplace_back("7.1 is not marked; the centre of head rotation is an estimate");
  }
}

RigidMotion rigid_motion_of(PartRole role) {
  if (role == PartRole::left_eye) return RigidMotion::left_eye;
  if (role == PartRole::right_eye) return RigidMotion::right_eye;
  return RigidMotion::none;
}

/// Lids of one skin close as far as it does not fold over; what they have to close is never nothing.
void stop_joined_lids(const Model& model, const Surface& surface, const std::vector<SurfacePoint>& points,
                      std::size_t eye, Rig& rig) {
  const mpeg4::Opening& opening = mpeg4::lids_of(eye);
  if (!rig.lids[eye] || !are_joined(surface, opening, points, hiding_ball(rig, eye))) return;
  Heights heights{};
  heights[parse_feature_point(opening.upper.front())->value()] = -rig.lids[eye]->opening;
  const double least = least_slit / rig.lids[eye]->slit;
  rig.lids[eye]->opening *= static_cast<float>(std::max(share_before_fold(model, rig, heights), least));
}

/// Skin whose distance from the ball is below this share of the ball's radius can be pushed into it.
constexpr double near_ball = 0.3;
/// What follows a corner of the eye by this share stays as that does: it would be lifted as the ball turns.
constexpr float of_corner = 0.5F;

/// The place before the front of one eyeball, without the corners of the eye.
class BallFront {
 public:
  BallFront(const Rig& rig, std::size_t eye)
      : influence_(rig.influence),
        pivot_(eye == 0 ? rig.left_eye_pivot : rig.right_eye_pivot),
        reach_((1.0 + near_ball) * *std::max_element(rig.lids[eye]->ball.begin(), rig.lids[eye]->ball.end())) {
    const auto& names = mpeg4::lids_of(eye).corners;
    std::transform(names.begin(), names.end(), std::back_inserter(corners_),
                   [](std::string_view name) { return *parse_feature_point(name); });
  }
  [[nodiscard]] bool contains(const glm::dvec3& position, std::uint32_t file_vertex) const {
    const glm::dvec3 from = position - pivot_;
    if (!(from.z > 0.0 && glm::length(from) < reach_)) return false;
    const auto row = influence_.points_of(file_vertex);
    const auto weights = influence_.weights_of(file_vertex);
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (weights[k] >= of_corner && std::find(corners_.begin(), corners_.end(), row[k]) != corners_.end())
        return false;
    }
    return !row.empty();
  }

 private:
  const WeightTable<float>& influence_;
  glm::dvec3 pivot_;
  double reach_;  ///< from the pivot, model units
  std::vector<FeaturePointId> corners_;
};

/// The vertices of lids: those that follow the points of one eye's lids, and skin that lies before its ball: a cheek or
/// a brow that moves does not pass through the ball either. A vertex that follows the lids of both eyes is skin.
void find_rolling_lids(const Model& model, const Surface& surface, const std::vector<SurfacePoint>& points,
                       const ModelledEyes& modelled, Rig& rig, std::vector<RigidMotion>& motion) {
  static const std::array<std::array<FeaturePointId, 2>, 2> lid_points = {
      {{*parse_feature_point("3.1"), *parse_feature_point("3.3")},
       {*parse_feature_point("3.2"), *parse_feature_point("3.4")}}};
  std::vector<RigidMotion> lids(motion.size(), RigidMotion::none);
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const std::optional<EyeEdges> edges = find_eye_edges(surface, points, eye, rig.parts);
    if (edges) rig.lids[eye] = find_lids(surface, *edges, rig, eye, modelled[eye] ? &*modelled[eye] : nullptr);
    if (!modelled[eye]) stop_joined_lids(model, surface, points, eye, rig);
    if (!rig.lids[eye]) continue;
    const BallFront front(rig, eye);
    for (std::size_t s = 0; s < motion.size(); ++s) {
      if (motion[s] != RigidMotion::none) continue;
      const std::uint32_t file_vertex = surface.file_vertex_of[s].value();
      const auto row = rig.influence.points_of(file_vertex);
      const bool follows = std::any_of(row.begin(), row.end(), [&](FeaturePointId id) {
        return id == lid_points[eye][0] || id == lid_points[eye][1];
      });
      const bool is_skin = rig.parts[surface.part_of[s].value()].role == PartRole::skin;
      if (!follows && !(is_skin && front.contains(surface.positions[s], file_vertex))) continue;
      const bool is_of_both = lids[s] != RigidMotion::none;
      lids[s] = is_of_both ? RigidMotion::none : eye == 0 ? RigidMotion::left_lids : RigidMotion::right_lids;
    }
  }
  for (std::size_t s = 0; s < motion.size(); ++s) {
    if (lids[s] != RigidMotion::none) motion[s] = lids[s];
  }
}

/// Data for the FAPs that move parts: the places and vertices of irises (FAPs 29, 30), lids and tongue (47).
void find_moving_parts(const Model& model, const Surface& surface, const std::vector<SurfacePoint>& points,
                       std::span<const MouthShare> mouth, bool rolls, const ModelledEyes& modelled, Rig& rig) {
  std::vector<RigidMotion> motion(surface.vertex_count(), RigidMotion::none);
  for (std::size_t s = 0; s < motion.size(); ++s)
    motion[s] = rigid_motion_of(rig.parts[surface.part_of[s].value()].role);
  const auto iris_diameter =
      rig.fapu[FapuUnit::irisd] ? std::optional(1024.0 * *rig.fapu[FapuUnit::irisd]) : std::nullopt;
  for (std::size_t eye = 0; eye < rig.irises.size(); ++eye) {
    const bool left = eye == 0;
    const PartRole role = left ? PartRole::left_eye : PartRole::right_eye;
    std::string why_not;
    const auto iris = find_iris(model, surface, rig.parts, role, rig.points,
                                left ? rig.left_eye_pivot : rig.right_eye_pivot, iris_diameter, why_not);
    if (!iris) {
      rig.warnings.push_back(std::string(left ? "the left eye " : "the right eye ") + why_not + "; FAP " +
                             (left ? "29" : "30") + " does nothing");
      continue;
    }
    rig.irises[eye] = iris->shape;
    for (const SurfaceVertexId v : iris->vertices) {
      motion[v.value()] = left ? RigidMotion::left_iris : RigidMotion::right_iris;
    }
  }
  if (rolls) find_rolling_lids(model, surface, points, modelled, rig, motion);
  if (const auto tongue = find_tongue(surface, rig.parts, points, mouth)) {
    rig.tongue = tongue->shape;
    for (std::size_t s = 0; s < motion.size(); ++s) {
      if (tongue->share[s] > 0.0) motion[s] = tongue_motion(tongue->share[s]);
    }
  } else {
    rig.warnings.emplace_back("there is no tongue; FAP 47 rolls nothing");
  }
  rig.rigid_of_vertex.reserve(surface.surface_of.size());
  for (const SurfaceVertexId vertex : surface.surface_of) rig.rigid_of_vertex.push_back(motion[vertex.value()]);
  if (rolls) lift_coarse_lids(model, rig);
}

Error no_own_shapes(const Model& model) {
  return {ErrorCode::missing, "/weights",
          model.examples.empty()
              ? "fitted weights need shapes of the head's own (morph targets), and the model has none: choose smooth"
              : "fitted weights need shapes that move some feature points and leave others at rest, and none of the " +
                    std::to_string(model.examples.size()) + " morph targets of the model does: choose smooth"};
}

}  // namespace

Result<Rig> parametrize(const Model& model, const Surface& surface, const FeaturePointSet& points,
                        const ParametrizeOptions& options) {
  if (model.triangles.empty()) return Error{ErrorCode::empty, "", "the model has no triangles"};
  const std::vector<SurfacePoint> on_surface = surface_points(surface, points);
  Rig rig;
  rig.points = points;
  rig.fapu = compute_fapu(points, options.fapu_by_user);
  WeightOptions weight_options;
  weight_options.method = options.weights;
  weight_options.eye_separation = 1024.0 * rig.fapu[FapuUnit::es].value_or(0.0);
  std::optional<Surface> unfolded;
  if (options.metric == DistanceMetric::unfolded) {
    unfolded = with_unfolded_diagonals(surface, model.triangles);
    weight_options.distance_graph = &*unfolded;
  }
  rig.parts = describe_parts(model, surface, points, options.roles_by_user);
  weight_options.parts = rig.parts;
  OwnShapes own;
  if (options.weights == WeightMethod::fitted) {
    own = own_shapes(model, surface, on_surface);
    if (own.shapes.empty()) return no_own_shapes(model);
    weight_options.shapes = own.shapes;
    for (const Part& part : rig.parts) weight_options.fitted_parts.push_back(part.role == PartRole::skin);
  }
  if (are_shares(options.weights))
    weight_options.modelled_eyes = find_modelled_eyes(surface, model.triangles, rig.parts, on_surface);
  Result<SurfaceWeights> weighed = surface_weights(surface, on_surface, options.progress, weight_options);
  if (!weighed) return weighed.error();
  const WeightTable<double>* const weights = &weighed->rows;
  if (options.weights == WeightMethod::fitted) rig.fit = WeightFit{std::move(weighed->errors), std::move(own.ignored)};

  const NeckJoints joints = plausible_joints(model.neck_joints, rig.parts, points);
  rig.head_pivot = head_pivot(rig.parts, points, joints);
  std::vector<std::uint8_t> turn = turn_with_head(surface, rig.parts, points, rig.head_pivot, joints);
  if (!turn.empty()) unfold_neck(surface, model.triangles, rig.head_pivot, turn);
  rig.weights = rows_of_file_vertices(surface, *weights);
  const std::vector<MouthShare> mouth = share_of_jaw(surface, rig.parts, on_surface);
  rig.influence = rows_of_file_vertices(
      surface, influence_with_roles(surface, rig.parts, on_surface, mouth, *weights, options.weights));
  rig.part_of_vertex.reserve(surface.surface_of.size());
  for (const SurfaceVertexId vertex : surface.surface_of) {
    rig.part_of_vertex.push_back(surface.part_of[vertex.value()]);
  }
  // Not with the weights of Eq. 4: the skin between facing points follows the points of the other lip and
  // of the outer lips as much, so the gaps would mean little.
  if (are_shares(options.weights)) rig.lip_gaps = measure_lip_gaps(model, surface, rig);
  rig.left_eye_pivot = eye_pivot(surface, rig.parts, PartRole::left_eye, points);
  rig.right_eye_pivot = eye_pivot(surface, rig.parts, PartRole::right_eye, points);
  const ModelledEyes& modelled = weight_options.modelled_eyes;
  if (modelled[0] && modelled[0]->ball) rig.left_eye_pivot = glm::vec3(modelled[0]->ball->center);
  if (modelled[1] && modelled[1]->ball) rig.right_eye_pivot = glm::vec3(modelled[1]->ball->center);
  if (!turn.empty()) {
    for (const SurfaceVertexId vertex : surface.surface_of) rig.turn_of_vertex.push_back(turn[vertex.value()]);
  }

  rig.warnings = explain_missing_fapu(rig.fapu, points);
  warn_of_closed_eyes(rig.fapu, rig.warnings);
  warn_of_points(surface, on_surface, rig.warnings);
  warn_of_parts(rig.parts, points, rig.warnings);
  find_moving_parts(model, surface, on_surface, mouth, are_shares(options.weights), modelled, rig);
  if (options.progress && !options.progress(1.0, "done")) {
    return Error{ErrorCode::cancelled, "", "stopped on request"};
  }
  return rig;
}

}  // namespace semblante

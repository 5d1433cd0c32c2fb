#pragma once

#include "core/anatomy/modelled_eye.h"
#include "core/anatomy/points_on_eyes.h"
#include "core/anatomy/rim_points.h"
#include "core/doctor/face_axes.h"
#include "core/doctor/mesh_sides.h"
#include "core/geometry/surface.h"
#include "core/parametrize/weight_method.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

/// A parametrized head under examination, with data shared by several checks.
struct Subject {
  const Model& model;
  const Surface& surface;
  const MeshSides& mesh;
  const Rig& rig;
  WeightMethod method;
  FaceAxes frame;
  std::vector<MisplacedRimPoint> misplaced = {};   ///< of find_misplaced_rim_points
  std::vector<PointOnEye> on_eyes = {};            ///< of find_points_on_eyes
  std::vector<SurfacePoint> points_in_place = {};  ///< without the misplaced: with one an opening looks like none
  ModelledEyes modelled_eyes = {};                 ///< of find_modelled_eyes, by the points in place
};

}  // namespace semblante

#pragma once

#include <array>
#include <vector>

#include "core/kernel/semblante_kernel.h"

/// Eq. 5, 6, 7 and the rigid motions, literally and in double: slow, with matrices and libm, sharing no code with the
/// kernel.
namespace semblante::oracle {

using Vec3 = std::array<double, 3>;
using Matrix = std::array<Vec3, 3>;

struct Pose {
  std::array<Vec3, SEMBLANTE_FP_COUNT> fp{};
  std::array<Matrix, 2> eye{};
  std::array<Vec3, 2> eye_translation{};
  Matrix head{};
  std::array<double, 2> pupil_growth{};                ///< of the radius
  double tongue_roll = 0.0;                            ///< radians
  std::array<std::array<double, 2>, 2> lid_closure{};  ///< left, right; upper, lower
};

/// Rotation by `angle` radians about axis 0, 1 or 2, right-hand rule.
Matrix rotation(int axis, double angle);
Matrix operator*(const Matrix& a, const Matrix& b);
Vec3 operator*(const Matrix& m, const Vec3& v);

/// Reads the FAPs from core/tables/mpeg4.h, not from the kernel's own table.
Pose evaluate(const semblante_rig& rig, const semblante_frame& frame);

/// Eq. 7 with the quotients as they stand in the face, then irises, eyes, lids and tongue, then the head.
std::vector<Vec3> deform(const semblante_face& face, const semblante_rig& rig, const Pose& pose);

}  // namespace semblante::oracle

#include "tests/oracle/kernel_oracle.h"

#include <algorithm>
#include <cmath>

#include "core/tables/mpeg4.h"

namespace semblante::oracle {
namespace {

/// weight1 * table[entry1] + weight2 * table[entry2] for one FP; entries beyond the table are zero.
Vec3 blend(const float* table, int count, int entry1, double weight1, int entry2, double weight2, int fp) {
  Vec3 sum{};
  if (table == nullptr) return sum;
  for (int i = 0; i < 3; ++i) {
    const auto at = [&](int entry) {
      return entry < count ? static_cast<double>(table[(entry * 84 + fp) * 3 + i]) : 0.0;
    };
    sum[i] = weight1 * at(entry1) + weight2 * at(entry2);
  }
  return sum;
}

Vec3 turn_about(const Matrix& rotation, const float* pivot, const Vec3& p) {
  const Vec3 turned = rotation * Vec3{p[0] - pivot[0], p[1] - pivot[1], p[2] - pivot[2]};
  return {turned[0] + pivot[0], turned[1] + pivot[1], turned[2] + pivot[2]};
}

}  // namespace

Matrix rotation(int axis, double angle) {
  Matrix m{};
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  m[axis][axis] = 1.0;
  m[u][u] = std::cos(angle);
  m[u][v] = -std::sin(angle);
  m[v][u] = std::sin(angle);
  m[v][v] = std::cos(angle);
  return m;
}

Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
    }
  }
  return c;
}

Vec3 operator*(const Matrix& m, const Vec3& v) {
  Vec3 r{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) r[i] += m[i][j] * v[j];
  }
  return r;
}

Pose evaluate(const semblante_rig& rig, const semblante_frame& frame) {
  Pose pose;
  const double b = std::min<int>(frame.viseme_blend, 63) / 63.0;
  const double i1 = std::min<int>(frame.intensity1, 63) / 63.0;
  const double i2 = std::min<int>(frame.intensity2, 63) / 63.0;
  for (int fp = 0; fp < 84; ++fp) {
    const Vec3 v = blend(rig.viseme, 15, frame.viseme1, b, frame.viseme2, 1.0 - b, fp);
    const Vec3 e = blend(rig.expression, 7, frame.expression1, i1, frame.expression2, i2, fp);
    const bool in_viseme = v != Vec3{};
    const bool in_expression = e != Vec3{};
    for (int i = 0; i < 3; ++i) {
      if (in_viseme && in_expression) {
        pose.fp[fp][i] = rig.viseme_share * v[i] + (1.0 - rig.viseme_share) * e[i];  // Eq. 5
      } else {
        pose.fp[fp][i] = in_viseme ? v[i] : e[i];
      }
    }
  }

  const int left_pupil = 18;                     // 3.5: 14 points of group 2, then the fifth of group 3
  const int right_pupil = 19;                    // 3.6
  std::array<std::array<double, 3>, 3> angle{};  // left eye, right eye, head; by axis
  for (int n = 3; n <= 68; ++n) {
    const mpeg4::Fap& fap = mpeg4::fap(static_cast<std::size_t>(n));
    const double value = frame.fap[n];
    if (value == 0.0) continue;
    if (n == 29 || n == 30) {
      const semblante_iris& iris = rig.iris[n - 29];
      const double wanted = 0.5 * value * rig.fapu[0];
      const double room = static_cast<double>(iris.iris_radius) - iris.pupil_radius;
      pose.pupil_growth[n - 29] = std::max(-0.9 * iris.pupil_radius, std::min(0.9 * room, wanted));
      continue;
    }
    if (n == 47) {
      const double limit = rig.tongue.roll_limit;
      pose.tongue_roll = std::max(-limit, std::min(limit, value * mpeg4::radians_per_au));
      continue;
    }
    const int fp = fap.feature_points[0];
    const int part = fp == left_pupil ? 0 : fp == right_pupil ? 1 : 2;
    if (fap.kind == mpeg4::FapKind::rotation) {
      angle[part][fap.axis] = fap.sign * value * mpeg4::radians_per_au;
    } else {
      const double fapu = rig.fapu[static_cast<int>(fap.unit)];
      if (fapu == 0.0) continue;
      const double displacement = fap.sign * value * fapu;  // Eq. 6
      (part < 2 ? pose.eye_translation[part] : pose.fp[fp])[fap.axis] = displacement;
    }
  }
  const auto compose = [](const std::array<double, 3>& a) {
    return rotation(1, a[1]) * rotation(0, a[0]) * rotation(2, a[2]);
  };
  pose.eye = {compose(angle[0]), compose(angle[1])};
  pose.head = compose(angle[2]);
  return pose;
}

namespace {

double dot(const Vec3& a, const float* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Where a growing pupil takes a rest position: along polar coordinates about the axis, piecewise linear in the radius.
Vec3 with_pupil(const semblante_iris& iris, const float* pivot, double growth, const Vec3& rest) {
  if (iris.pupil_radius <= 0.0F) return rest;
  const Vec3 d{rest[0] - pivot[0], rest[1] - pivot[1], rest[2] - pivot[2]};
  const double along = dot(d, iris.axis);
  Vec3 outwards{};
  for (int i = 0; i < 3; ++i) outwards[i] = d[i] - along * iris.axis[i];
  const double r = std::sqrt(outwards[0] * outwards[0] + outwards[1] * outwards[1] + outwards[2] * outwards[2]);
  if (r == 0.0 || r >= iris.iris_radius) return rest;
  const double pupil = iris.pupil_radius + growth;
  const double to = r < iris.pupil_radius
                        ? r / iris.pupil_radius * pupil
                        : iris.iris_radius - (iris.iris_radius - r) / (iris.iris_radius - iris.pupil_radius) *
                                                 (iris.iris_radius - pupil);
  const double farther = iris.bend * (to * to - r * r);
  Vec3 result{};
  for (int i = 0; i < 3; ++i) result[i] = pivot[i] + (along + farther) * iris.axis[i] + outwards[i] * to / r;
  return result;
}

/// Where a rolled tongue takes a rest position: the arc walked in ten thousand straight steps.
Vec3 rolled(const semblante_tongue& tongue, double roll, const Vec3& rest) {
  if (tongue.half_width <= 0.0F || roll == 0.0) return rest;
  const Vec3 d{rest[0] - tongue.origin[0], rest[1] - tongue.origin[1], rest[2] - tongue.origin[2]};
  const double u = dot(d, tongue.left);
  const double v = dot(d, tongue.up);
  const double w = tongue.half_width;
  constexpr int steps = 10000;
  double x = 0.0;
  double y = 0.0;
  double angle = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double at = u * (i + 0.5) / steps;
    angle = roll * std::max(-1.0, std::min(1.0, at / w));
    x += std::cos(angle) * u / steps;
    y += std::sin(angle) * u / steps;
  }
  angle = roll * std::max(-1.0, std::min(1.0, u / w));
  x -= v * std::sin(angle);
  y += v * std::cos(angle);
  Vec3 result{};
  for (int i = 0; i < 3; ++i) result[i] = rest[i] + (x - u) * tongue.left[i] + (y - v) * tongue.up[i];
  return result;
}

Vec3 with_local_motion(const semblante_rig& rig, const Pose& pose, int rigid, const Vec3& rest) {
  if (rigid == 3 || rigid == 4) {
    return with_pupil(rig.iris[rigid - 3], rig.eye_pivot[rigid - 3], pose.pupil_growth[rigid - 3], rest);
  }
  return rigid >= 128 ? rolled(rig.tongue, pose.tongue_roll * (rigid - 127) / 128.0, rest) : rest;
}

}  // namespace

std::vector<Vec3> deform(const semblante_face& face, const semblante_rig& rig, const Pose& pose) {
  std::vector<Vec3> positions;
  for (std::uint32_t v = 0; v < face.vertex_count; ++v) {
    Vec3 sum_of_moves{};
    for (std::uint32_t e = face.row_offsets[v]; e < face.row_offsets[v + 1]; ++e) {
      for (int i = 0; i < 3; ++i) sum_of_moves[i] += face.row_weights[e] * pose.fp[face.row_points[e]][i];
    }
    const int rigid = face.rigid == nullptr ? 0 : face.rigid[v];
    const Vec3 rest{face.rest[v * 3], face.rest[v * 3 + 1], face.rest[v * 3 + 2]};
    Vec3 p = with_local_motion(rig, pose, rigid, rest);
    for (int i = 0; i < 3; ++i) p[i] += sum_of_moves[i];  // Eq. 7
    if (rigid != 0 && rigid < 128) {
      const int eye = (rigid - 1) % 2;
      p = turn_about(pose.eye[eye], rig.eye_pivot[eye], p);
      for (int i = 0; i < 3; ++i) p[i] += pose.eye_translation[eye][i];
    }
    positions.push_back(turn_about(pose.head, rig.head_pivot, p));
  }
  return positions;
}

}  // namespace semblante::oracle

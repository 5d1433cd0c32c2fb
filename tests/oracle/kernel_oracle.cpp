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
    if (value == 0.0 || fap.axis == mpeg4::no_axis) continue;
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

std::vector<Vec3> deform(const semblante_face& face, const semblante_rig& rig, const Pose& pose) {
  std::vector<Vec3> positions;
  for (std::uint32_t v = 0; v < face.vertex_count; ++v) {
    Vec3 sum_of_moves{};
    for (std::uint32_t e = face.row_offsets[v]; e < face.row_offsets[v + 1]; ++e) {
      for (int i = 0; i < 3; ++i) sum_of_moves[i] += face.row_weights[e] * pose.fp[face.row_points[e]][i];
    }
    Vec3 p{};
    for (int i = 0; i < 3; ++i) p[i] = face.rest[v * 3 + i] + sum_of_moves[i];  // Eq. 7
    const int rigid = face.rigid == nullptr ? 0 : face.rigid[v];
    if (rigid != 0) {
      p = turn_about(pose.eye[rigid - 1], rig.eye_pivot[rigid - 1], p);
      for (int i = 0; i < 3; ++i) p[i] += pose.eye_translation[rigid - 1][i];
    }
    positions.push_back(turn_about(pose.head, rig.head_pivot, p));
  }
  return positions;
}

}  // namespace semblante::oracle

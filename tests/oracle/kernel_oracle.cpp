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

namespace {

/// The companions of a rig, with what the FAPs of a frame say of the points.
struct Companions {
  const semblante_rig& rig;
  const Pose& sets;                 ///< by FAPs 1 and 2 alone
  const Pose& by_faps;              ///< by all FAPs
  const std::array<Vec3, 84>& own;  ///< 1 where a FAP moves the point along the axis

  template <typename F>
  void each(F&& f) const {
    for (std::uint32_t k = 0; k < rig.companion_count; ++k) f(rig.companion[k]);
  }
  bool leads(int point) const {
    bool result = false;
    each([&](const semblante_companion& c) { result = result || (c.is_choice == 0 && c.leader == point); });
    return result;
  }
  /// The whole way of the leader, or only what FAPs add to a set that has the point itself.
  Vec3 way(const semblante_companion& c, const Vec3& leader) const {
    const double share = c.share * (c.is_choice != 0 ? rig.lip_share : 1.0F);
    const bool in_set = sets.fp[c.point] != Vec3{};
    Vec3 result{};
    for (int i = 0; i < 3; ++i) {
      if (own[c.point][i] == 0.0) result[i] = share * (leader[i] - (in_set ? sets.fp[c.leader][i] : 0.0));
    }
    return result;
  }
  /// A leader leads by the FAPs and by what it follows itself.
  Vec3 led(int leader) const {
    Vec3 result = by_faps.fp[leader];
    each([&](const semblante_companion& c) {
      if (c.point != leader || c.is_choice != 0) return;
      const Vec3 followed = way(c, by_faps.fp[c.leader]);
      for (int i = 0; i < 3; ++i) result[i] += followed[i];
    });
    return result;
  }
};

void follow(const semblante_rig& rig, const Pose& sets, const std::array<Vec3, 84>& own, Pose& pose) {
  const Pose by_faps = pose;
  const Companions companions{rig, sets, by_faps, own};
  companions.each([&](const semblante_companion& c) {
    const bool is_leader = c.is_choice == 0 && companions.leads(c.point);
    const Vec3 way = companions.way(c, is_leader ? by_faps.fp[c.leader] : companions.led(c.leader));
    for (int i = 0; i < 3; ++i) pose.fp[c.point][i] += way[i];
  });
}

double limited(double value, double low, double high) { return std::max(low, std::min(high, value)); }

double between(const float* table, int count, double at) {
  const int k = std::min(static_cast<int>(at), count - 2);
  return table[k] + (at - k) * (static_cast<double>(table[k + 1]) - table[k]);
}

/// Of upper and lower lid, by the heights of their points.
struct Closures {
  double upper, lower;
};

double widest_closure(const semblante_lids& lids) {
  const double of_large_eye = std::min(0.0, 0.5 - 1.0 / lids.slit);
  return std::min(std::max(-0.75, of_large_eye), 1.0 - 0.75 / lids.slit);
}

Closures closures_of(const semblante_lids& lids, double upper_y, double lower_y) {
  const double widest = widest_closure(lids);
  return {limited(-upper_y / lids.opening, widest, 1.0), limited(lower_y / lids.opening, widest, 1.0)};
}

/// By how much an eye's pitch closes its lids, as far as they are open.
Closures closed_by_gaze(const semblante_lids& lids, const Closures& by_points, double pitch) {
  const double widest = widest_closure(lids);
  const double gaze = limited(pitch, -0.8, 0.8) / lids.slit;
  const double open = limited(1.0 - by_points.upper - by_points.lower, 0.0, 1.0);
  const double upper = limited(by_points.upper + open * lids.gaze_share[0] * gaze, widest, 1.0);
  const double lower = limited(by_points.lower - open * lids.gaze_share[1] * gaze, widest, 1.0);
  return {upper - by_points.upper, lower - by_points.lower};
}

}  // namespace

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

  const Pose sets = pose;
  std::array<Vec3, 84> own{};                                  // 1 where a FAP moves the point along the axis
  const int left_pupil = 18;                                   // 3.5: 14 points of group 2, then the fifth of group 3
  const int right_pupil = 19;                                  // 3.6
  const auto upper_lid_of = [](int eye) { return 14 + eye; };  // 3.1, 3.2
  const auto lower_lid_of = [](int eye) { return 16 + eye; };  // 3.3, 3.4
  std::array<std::array<double, 3>, 3> angle{};                // left eye, right eye, head; by axis
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
      double fapu = rig.fapu[static_cast<int>(fap.unit)];
      if (fapu == 0.0) continue;
      if (fp >= upper_lid_of(0) && fp <= lower_lid_of(1))
        fapu = std::max(fapu, rig.lids[fp % 2].opening / 1024.0);  // left lids have even indices
      const double displacement = fap.sign * value * fapu;         // Eq. 6
      (part < 2 ? pose.eye_translation[part] : pose.fp[fp])[fap.axis] = displacement;
      own[fp][fap.axis] = 1.0;
    }
  }
  for (int eye = 0; eye < 2; ++eye) {
    const double opening = rig.lids[eye].opening;
    if (opening <= 0.0) continue;
    double& upper = pose.fp[upper_lid_of(eye)][1];
    double& lower = pose.fp[lower_lid_of(eye)][1];
    upper = std::max(-opening, upper);
    lower = std::min(opening, lower);
    const Closures by_gaze = closed_by_gaze(rig.lids[eye], closures_of(rig.lids[eye], upper, lower), angle[eye][0]);
    upper -= opening * by_gaze.upper;
    lower += opening * by_gaze.lower;
  }
  follow(rig, sets, own, pose);
  for (int eye = 0; eye < 2; ++eye) {
    if (rig.lids[eye].opening <= 0.0F) continue;
    const Closures closures = closures_of(rig.lids[eye], pose.fp[upper_lid_of(eye)][1], pose.fp[lower_lid_of(eye)][1]);
    const double both = std::max(1.0, closures.upper + closures.lower);
    pose.lid_closure[eye] = {closures.upper / both, closures.lower / both};
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

double size_of(const Vec3& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/// Rodrigues' formula.
Vec3 turned(const Vec3& v, const Vec3& axis, double angle) {
  const Vec3 across{axis[1] * v[2] - axis[2] * v[1], axis[2] * v[0] - axis[0] * v[2], axis[0] * v[1] - axis[1] * v[0]};
  const double along = axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2];
  Vec3 result{};
  for (int i = 0; i < 3; ++i) {
    result[i] = std::cos(angle) * v[i] + std::sin(angle) * across[i] + (1.0 - std::cos(angle)) * along * axis[i];
  }
  return result;
}

double ball_towards(const semblante_lids& lids, const Vec3& pole, const Vec3& d) {
  const double cosine = (d[0] * pole[0] + d[1] * pole[1] + d[2] * pole[2]) / size_of(d);
  return between(lids.ball, 17, 16.0 * std::sqrt(1.0 - limited(cosine, 0.0, 1.0)));
}

/// A vertex of lids: `p`, by the other points alone, taken to its height on its circle and kept off the ball.
Vec3 with_lid(const semblante_rig& rig, const Pose& pose, int eye, double upper, double lower, const Vec3& rest,
              const Vec3& p) {
  const semblante_lids& lids = rig.lids[eye];
  const float* const pivot = rig.eye_pivot[eye];
  const Vec3 from{rest[0] - pivot[0], rest[1] - pivot[1], rest[2] - pivot[2]};
  Vec3 arm{p[0] - pivot[0], p[1] - pivot[1], p[2] - pivot[2]};
  const double way = lids.opening * (lower * pose.lid_closure[eye][1] - upper * pose.lid_closure[eye][0]);
  const double radius = std::hypot(arm[1], arm[2]);
  if (arm[2] > 0.05 * radius && way != 0.0) {
    const double sine = (arm[1] + way) / radius;
    arm[2] = std::abs(sine) < 1.0 ? std::max(0.05 * radius, radius * std::cos(std::asin(sine))) : 0.05 * radius;
  }
  arm[1] += way;
  const double hidden = 0.03 * lids.ball[16];
  if (hidden > 0.0) {
    const double wanted = hidden + lids.lift * std::min<double>(lids.opening, std::abs(arm[1] - from[1]));
    const Vec3 rest_pole{lids.gaze[0], lids.gaze[1], lids.gaze[2]};
    double clearance = std::min(wanted, size_of(from) - ball_towards(lids, rest_pole, from));
    const Vec3 pole = pose.eye[eye] * rest_pole;
    const double swing = size_of({pole[0] - rest_pole[0], pole[1] - rest_pole[1], pole[2] - rest_pole[2]});
    if (clearance > -hidden)
      clearance += std::min(1.0, (std::abs(way) / lids.ball[16] + swing) / 0.1) * (wanted - clearance);
    Vec3 from_ball{};
    for (int i = 0; i < 3; ++i) from_ball[i] = arm[i] - pose.eye_translation[eye][i];
    const double least = ball_towards(lids, pole, from_ball) + clearance;
    if (size_of(from_ball) < least) {
      const double flat = std::hypot(from_ball[0], from_ball[1]) / least;  // sine of the angle to straight ahead
      const double stretch = least / size_of(from_ball);
      if (from_ball[2] > 0.0 && flat * flat < 0.75) {
        from_ball[2] = least * std::cos(std::asin(flat));
      } else {
        for (double& component : from_ball) component *= stretch;
      }
      for (int i = 0; i < 3; ++i) arm[i] = from_ball[i] + pose.eye_translation[eye][i];
    }
  }
  return {pivot[0] + arm[0], pivot[1] + arm[1], pivot[2] + arm[2]};
}

/// The rotation of a vertex that has a share of the head's: between none and it, by normalized linear interpolation of
/// quaternions, which is a rotation about the same axis with tan(half of it) = share sin / ((1 - share) + share cos).
Matrix part_of(const Matrix& head, double share) {
  const Vec3 axis{head[2][1] - head[1][2], head[0][2] - head[2][0], head[1][0] - head[0][1]};
  const double size = size_of(axis);
  if (size < 1e-12) return head;  // no turn
  const double half = 0.5 * std::acos(limited((head[0][0] + head[1][1] + head[2][2] - 1.0) / 2.0, -1.0, 1.0));
  const double angle = 2.0 * std::atan2(share * std::sin(half), (1.0 - share) + share * std::cos(half));
  Matrix part{};
  for (int column = 0; column < 3; ++column) {
    Vec3 unit{};
    unit[column] = 1.0;
    const Vec3 to = turned(unit, {axis[0] / size, axis[1] / size, axis[2] / size}, angle);
    for (int row = 0; row < 3; ++row) part[row][column] = to[row];
  }
  return part;
}

}  // namespace

std::vector<Vec3> deform(const semblante_face& face, const semblante_rig& rig, const Pose& pose) {
  std::vector<Vec3> positions;
  for (std::uint32_t v = 0; v < face.vertex_count; ++v) {
    Vec3 sum_of_moves{};
    const int motion = face.rigid == nullptr ? 0 : face.rigid[v];
    const int lids = (motion == 5 || motion == 6) && rig.lids[motion - 5].opening > 0.0F ? motion - 5 : -1;
    double upper = 0.0;
    double lower = 0.0;
    for (std::uint32_t e = face.row_offsets[v]; e < face.row_offsets[v + 1]; ++e) {
      if (lids >= 0 && (face.row_points[e] == 14 + lids || face.row_points[e] == 16 + lids)) {
        (face.row_points[e] == 14 + lids ? upper : lower) = face.row_weights[e];
        continue;
      }
      for (int i = 0; i < 3; ++i) sum_of_moves[i] += face.row_weights[e] * pose.fp[face.row_points[e]][i];
    }
    const int rigid = face.rigid == nullptr ? 0 : face.rigid[v];
    const Vec3 rest{face.rest[v * 3], face.rest[v * 3 + 1], face.rest[v * 3 + 2]};
    Vec3 p = with_local_motion(rig, pose, rigid, rest);
    for (int i = 0; i < 3; ++i) p[i] += sum_of_moves[i];  // Eq. 7
    if (lids >= 0) p = with_lid(rig, pose, lids, upper, lower, rest, p);
    if (rigid >= 1 && rigid <= 4) {
      const int eye = (rigid - 1) % 2;
      p = turn_about(pose.eye[eye], rig.eye_pivot[eye], p);
      for (int i = 0; i < 3; ++i) p[i] += pose.eye_translation[eye][i];
    }
    const int turn = face.turn == nullptr ? 255 : face.turn[v];
    const Matrix head = turn == 255 ? pose.head : part_of(pose.head, turn / 255.0);
    positions.push_back(turn_about(head, rig.head_pivot, p));
  }
  return positions;
}

}  // namespace semblante::oracle

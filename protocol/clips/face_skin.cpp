#include "protocol/clips/face_skin.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <numeric>
#include <span>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace semblante {
namespace {

constexpr std::size_t head_joint = 0;
constexpr std::uint32_t whole = 65535;
constexpr std::uint8_t whole_turn = 255;
constexpr std::size_t max_joints = 256;  // their numbers are bytes

/// Tolerance of the sum of a quantized row, above one.
constexpr double sum_slack = 1.0 / 256.0;

struct Influence {
  std::size_t joint = 0;
  double share = 0.0;
};

/// The share of the pupil's motion at a vertex of an iris, from 1 inside to 0 at the rim (SPEC 1.4, step 5).
double pupil_share(const Iris& iris, glm::vec3 from_pivot) {
  const float along = glm::dot(from_pivot, iris.axis);
  const double r = glm::length(from_pivot - along * iris.axis);
  const double pupil = iris.pupil_radius;
  const double rim = iris.iris_radius;
  if (r <= pupil) return 1.0;
  return r < rim ? pupil * (rim - r) / ((rim - pupil) * r) : 0.0;
}

/// The rotation from z to `axis`.
glm::quat turn_to(glm::vec3 axis) {
  const glm::vec3 z(0.0F, 0.0F, 1.0F);
  const float cosine = glm::dot(z, axis);
  if (cosine < -0.9999F) return {0.0F, 1.0F, 0.0F, 0.0F};  // half a turn about x
  const glm::vec3 across = glm::cross(z, axis);
  return glm::normalize(glm::quat(1.0F + cosine, across.x, across.y, across.z));
}

/// One vertex of an iris: its coordinate along the axis, its share of the pupil's motion, bend * r * r.
struct IrisVertex {
  double along = 0.0, share = 0.0, curve = 0.0;
};

/// The kernel moves a vertex inwards by curve * (2 s share + s s share^2), a joint by share * (scale * along + shift):
/// returns the best scale and shift for the term with s and for that with s s. On the surface described by the rig the
/// former is exact; eyes with several layers have a remaining error.
std::array<glm::vec2, 2> nearest_sink(std::span<const IrisVertex> vertices) {
  double zz = 0.0;
  double z = 0.0;
  double one = 0.0;
  std::array<double, 2> to_z{};
  std::array<double, 2> to_one{};
  for (const IrisVertex& v : vertices) {
    const double across = v.share * v.along;
    zz += across * across;
    z += across * v.share;
    one += v.share * v.share;
    for (std::size_t term = 0; term < 2; ++term) {
      const double wanted = v.curve * v.share * (term == 0 ? 1.0 : v.share);
      to_z[term] += across * wanted;
      to_one[term] += v.share * wanted;
    }
  }
  const double determinant = zz * one - z * z;
  std::array<glm::vec2, 2> out{};
  for (std::size_t term = 0; term < 2 && one > 0.0; ++term) {
    if (determinant > 1e-9 * zz * one) {
      out[term] = {(to_z[term] * one - to_one[term] * z) / determinant,
                   (to_one[term] * zz - to_z[term] * z) / determinant};
    } else {
      out[term] = {0.0, to_one[term] / one};  // flat: nothing to scale
    }
  }
  return out;
}

/// Creates the joints as the rows need them.
class SkinMaker {
 public:
  SkinMaker(const PackedFace& face, int influences) : face_(face), wanted_(static_cast<std::size_t>(influences)) {
    skin_.joints.push_back({FaceJoint::Kind::head, "head", std::nullopt, face.rig.head_pivot});
    for (std::size_t eye = 0; eye < 2; ++eye) add_eye(eye);
    for (std::size_t eye = 0; eye < 2; ++eye) add_lids(eye);
    const auto& turn = face.table.turn;
    if (std::all_of(turn.begin(), turn.end(), [](std::uint8_t t) { return t == whole_turn; })) return;
    body_joint_ = skin_.joints.size();
    skin_.joints.front().parent = body_joint_;
    skin_.joints.push_back({FaceJoint::Kind::body, "body", std::nullopt, face.rig.head_pivot});
  }

  Result<FaceSkin> make() {
    const std::size_t vertices = face_.mesh.positions.size();
    std::vector<std::vector<Influence>> rows(vertices);
    std::size_t most = 1;
    for (std::size_t v = 0; v < vertices; ++v) {
      rows[v] = row_of(v);
      cut(rows[v]);
      keep_with_body(rows[v], v);
      most = std::max(most, rows[v].size());
    }
    if (skin_.joints.size() > max_joints) {
      return Error{ErrorCode::unsupported, "weights", "rows that sum to much more than one ask for too many joints"};
    }
    skin_.influences = (most + 3) / 4 * 4;
    skin_.joint.resize(vertices * skin_.influences);
    skin_.share.resize(vertices * skin_.influences);
    for (std::size_t v = 0; v < vertices; ++v) write(rows[v], v * skin_.influences);
    if (eyes_with_rows_ > 0) {
      skin_.warnings.push_back(std::to_string(eyes_with_rows_) +
                               " vertices of eyes follow feature points as well; here they only turn with the eye");
    }
    return std::move(skin_);
  }

 private:
  [[nodiscard]] static std::size_t eye_of(std::uint8_t rigid) { return is_left_eye(RigidMotion{rigid}) ? 0 : 1; }

  void add_eye(std::size_t eye) {
    const auto of_eye = [&](std::uint8_t rigid) { return is_eye(RigidMotion{rigid}) && eye_of(rigid) == eye; };
    if (std::none_of(face_.table.rigid.begin(), face_.table.rigid.end(), of_eye)) return;
    const std::string side = eye == 0 ? "left" : "right";
    const glm::vec3 pivot = face_.rig.eye_pivots[eye];
    eye_joint_[eye] = skin_.joints.size();
    FaceJoint joint{FaceJoint::Kind::eye, side + "_eye", head_joint, pivot};
    joint.index = eye;
    skin_.joints.push_back(joint);
    const std::optional<Iris>& iris = face_.rig.irises[eye];
    const RigidMotion motion = eye == 0 ? RigidMotion::left_iris : RigidMotion::right_iris;
    std::vector<IrisVertex> vertices;
    double apex = 0.0;  // of the surface: at distance r it lies bend * r * r farther along the axis
    for (std::size_t v = 0; v < face_.mesh.positions.size(); ++v) {
      if (!iris || RigidMotion{face_.table.rigid[v]} != motion) continue;
      const glm::vec3 d = face_.mesh.positions[v] - pivot;
      const float along = glm::dot(d, iris->axis);
      const glm::vec3 out = d - along * iris->axis;
      vertices.push_back({along, pupil_share(*iris, d), iris->bend * glm::dot(out, out)});
      apex += along - vertices.back().curve;
    }
    if (vertices.empty()) return;
    apex /= static_cast<double>(vertices.size());
    for (IrisVertex& vertex : vertices) vertex.along -= apex;
    joint.sink = nearest_sink(vertices);
    pupil_joint_[eye] = skin_.joints.size();
    joint.kind = FaceJoint::Kind::pupil;
    joint.name = side + "_pupil";
    joint.parent = eye_joint_[eye];
    joint.place = pivot + static_cast<float>(apex) * iris->axis;
    joint.facing = turn_to(iris->axis);
    skin_.joints.push_back(joint);
  }

  void add_lids(std::size_t eye) {
    const std::optional<Lids>& lids = face_.rig.lids[eye];
    const RigidMotion motion = eye == 0 ? RigidMotion::left_lids : RigidMotion::right_lids;
    const auto& rigid = face_.table.rigid;
    if (!lids || std::find(rigid.begin(), rigid.end(), static_cast<std::uint8_t>(motion)) == rigid.end()) return;
    for (std::size_t lid = 0; lid < 2; ++lid) {
      const std::string name = std::string(eye == 0 ? "left" : "right") + (lid == 0 ? "_upper_lid" : "_lower_lid");
      FaceJoint joint{FaceJoint::Kind::lid, name, head_joint, face_.rig.eye_pivots[eye]};
      joint.index = eye * 2 + lid;
      lid_joint_[joint.index] = skin_.joints.size();
      skin_.joints.push_back(joint);
    }
  }

  /// The joint that carries an influence of a vertex: a lid its own points.
  std::size_t carrier_of(std::size_t v, FeaturePointId id, int gain) {
    const auto motion = RigidMotion{face_.table.rigid[v]};
    const std::size_t eye = motion == RigidMotion::right_lids ? 1 : 0;
    const bool of_lids = motion == RigidMotion::left_lids || motion == RigidMotion::right_lids;
    if (of_lids && lid_joint_[eye * 2]) {
      static const std::array<FeaturePointId, 4> lids = {*parse_feature_point("3.1"), *parse_feature_point("3.3"),
                                                         *parse_feature_point("3.2"), *parse_feature_point("3.4")};
      for (const std::size_t lid : {0U, 1U}) {
        if (id == lids[eye * 2 + lid]) return *lid_joint_[eye * 2 + lid];
      }
    }
    return point_joint(id, gain);
  }

  /// Takes from a row what its vertex does not have of the head's rotation.
  void keep_with_body(std::vector<Influence>& row, std::size_t v) const {
    if (!body_joint_ || face_.table.turn[v] == whole_turn) return;
    const double turn = face_.table.turn[v] / static_cast<double>(whole_turn);
    for (Influence& i : row) i.share *= turn;
    // The smallest share makes room: neck and body hardly follow points.
    if (row.size() >= wanted_) row.pop_back();
    double sum = 0.0;
    for (const Influence& i : row) sum += i.share;
    row.push_back({*body_joint_, 1.0 - sum});
    std::sort(row.begin(), row.end(), [](const Influence& a, const Influence& b) {
      return a.share != b.share ? a.share > b.share : a.joint < b.joint;
    });
  }

  std::size_t point_joint(FeaturePointId id, int gain) {
    const auto [at, added] = point_joint_.emplace(std::pair(id.value(), gain), skin_.joints.size());
    if (!added) return at->second;
    FaceJoint joint{FaceJoint::Kind::point, "fp_" + to_string(id), head_joint, face_.rig.head_pivot};
    if (gain > 1) joint.name += "_x" + std::to_string(gain);
    for (const RigDocument::Point& point : face_.rig.feature_points) {
      if (point.id == id) joint.place = point.position;
    }
    joint.index = id.value();
    joint.gain = static_cast<float>(gain);
    skin_.joints.push_back(joint);
    return at->second;
  }

  std::vector<Influence> eye_row(std::size_t v) {
    const auto motion = RigidMotion{face_.table.rigid[v]};
    const std::size_t eye = eye_of(face_.table.rigid[v]);
    const bool iris = motion == RigidMotion::left_iris || motion == RigidMotion::right_iris;
    if (!face_.table.rows.points_of(v).empty()) ++eyes_with_rows_;
    if (!iris || !pupil_joint_[eye]) return {{*eye_joint_[eye], 1.0}};
    const double share = pupil_share(*face_.rig.irises[eye], face_.mesh.positions[v] - face_.rig.eye_pivots[eye]);
    return {{*pupil_joint_[eye], share}, {*eye_joint_[eye], 1.0 - share}};
  }

  std::vector<Influence> row_of(std::size_t v) {
    if (is_eye(RigidMotion{face_.table.rigid[v]})) return eye_row(v);
    const auto points = face_.table.rows.points_of(v);
    const auto weights = face_.table.rows.weights_of(v);
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    const int gain = std::max(1, static_cast<int>(std::ceil(sum - sum_slack)));
    std::vector<Influence> row;
    double taken = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!(weights[i] > 0.0F)) continue;
      row.push_back({carrier_of(v, points[i], gain), static_cast<double>(weights[i]) / gain});
      taken += row.back().share;
    }
    const double rest = 1.0 - taken;
    if (rest > 0.0) row.push_back({head_joint, rest});
    return row;
  }

  /// Sorts the shares in decreasing order and truncates them to the maximum number. Dropped shares are distributed to
  /// the others in proportion, but the head keeps its share, so that the vertex does not move farther than its points.
  void cut(std::vector<Influence>& row) {
    const auto greater = [](const Influence& a, const Influence& b) {
      return a.share != b.share ? a.share > b.share : a.joint < b.joint;
    };
    std::sort(row.begin(), row.end(), greater);
    if (row.size() > wanted_) {
      row.resize(wanted_);
      ++skin_.cut_vertices;
    }
    double moving = 0.0;
    double still = 0.0;
    for (const Influence& i : row) (i.joint == head_joint ? still : moving) += i.share;
    if (moving <= 0.0) {
      row.assign(1, {head_joint, 1.0});
      return;
    }
    for (Influence& i : row) {
      if (i.joint != head_joint) i.share *= (1.0 - still) / moving;
    }
    std::sort(row.begin(), row.end(), greater);
  }

  /// Integers with the sum `whole`: each is rounded down, the rest goes to those with the largest remainders.
  void write(const std::vector<Influence>& row, std::size_t at) {
    std::array<std::uint32_t, 16> levels{};
    std::array<std::size_t, 16> order{};
    std::array<double, 16> lost{};
    assert(row.size() <= levels.size());
    std::uint32_t left = whole;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const double exact = row[i].share * whole;
      levels[i] = std::min(left, static_cast<std::uint32_t>(std::max(0.0, std::floor(exact))));
      lost[i] = exact - levels[i];
      left -= levels[i];
      order[i] = i;
    }
    std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(row.size()),
              [&](std::size_t a, std::size_t b) { return lost[a] != lost[b] ? lost[a] > lost[b] : a < b; });
    for (std::size_t i = 0; left > 0; i = (i + 1) % row.size(), --left) ++levels[order[i]];
    for (std::size_t i = 0; i < row.size(); ++i) {
      skin_.share[at + i] = static_cast<std::uint16_t>(levels[i]);
      if (levels[i] > 0) skin_.joint[at + i] = static_cast<std::uint8_t>(row[i].joint);
    }
  }

  const PackedFace& face_;
  const std::size_t wanted_;
  FaceSkin skin_;
  std::array<std::optional<std::size_t>, 2> eye_joint_, pupil_joint_;
  std::array<std::optional<std::size_t>, 4> lid_joint_;
  std::optional<std::size_t> body_joint_;
  std::map<std::pair<std::uint8_t, int>, std::size_t> point_joint_;
  std::size_t eyes_with_rows_ = 0;
};

glm::quat as_quat(const float (&q)[4]) { return {q[3], q[0], q[1], q[2]}; }
glm::vec3 as_vector(const float* v) { return {v[0], v[1], v[2]}; }

glm::mat4 as_matrix(const JointTransform& t) {
  return glm::translate(glm::mat4(1.0F), t.translation) * glm::mat4_cast(t.rotation) *
         glm::scale(glm::mat4(1.0F), t.scale);
}

}  // namespace

Result<FaceSkin> make_face_skin(const PackedFace& face, int influences) { return SkinMaker(face, influences).make(); }

JointTransform joint_transform(const FaceSkin& skin, std::size_t joint, const semblante_pose& pose) {
  const FaceJoint& j = skin.joints[joint];
  JointTransform out;
  out.translation = j.parent ? j.place - skin.joints[*j.parent].place : j.place;
  out.rotation = j.facing;
  switch (j.kind) {
    case FaceJoint::Kind::head:
      out.rotation = as_quat(pose.head_rotation);
      break;
    case FaceJoint::Kind::eye:
      out.translation += as_vector(pose.eye_translation[j.index]);
      out.rotation = as_quat(pose.eye_rotation[j.index]);
      break;
    case FaceJoint::Kind::pupil: {
      const float radius = pose.iris[j.index].pupil_radius;
      const float growth = radius > 0.0F ? pose.pupil_growth[j.index] / radius : 0.0F;
      const glm::vec2 sink = 2.0F * growth * j.sink[0] + growth * growth * j.sink[1];
      out.scale = {1.0F + growth, 1.0F + growth, std::max(0.01F, 1.0F + sink.x)};
      out.translation += j.facing * glm::vec3(0.0F, 0.0F, sink.y);
      break;
    }
    case FaceJoint::Kind::lid: {
      const semblante_lids& lids = pose.lids[j.index / 2];
      const float closure = pose.lid_closure[j.index / 2][j.index % 2];
      // Upwards is the right-hand rule about -x.
      const float angle = lids.slit * (j.index % 2 == 0 ? -closure : closure);
      out.rotation = glm::angleAxis(angle, glm::vec3(-1.0F, 0.0F, 0.0F));
      break;
    }
    case FaceJoint::Kind::body:
      break;
    case FaceJoint::Kind::point:
      out.translation += j.gain * as_vector(&pose.fp[j.index * 3]);
      break;
  }
  return out;
}

glm::mat4 inverse_bind(const FaceJoint& joint) {
  return glm::mat4_cast(glm::conjugate(joint.facing)) * glm::translate(glm::mat4(1.0F), -joint.place);
}

void skin_positions(const FaceSkin& skin, std::span<const glm::vec3> rest, const semblante_pose& pose,
                    std::size_t influences, std::span<glm::vec3> positions) {
  std::vector<glm::mat4> world(skin.joints.size());
  std::vector<glm::mat4> matrices(skin.joints.size());
  for (const bool is_root : {true, false}) {  // the body comes after its children
    for (std::size_t j = 0; j < skin.joints.size(); ++j) {
      if (is_root == skin.joints[j].parent.has_value()) continue;
      const glm::mat4 local = as_matrix(joint_transform(skin, j, pose));
      world[j] = skin.joints[j].parent ? world[*skin.joints[j].parent] * local : local;
      matrices[j] = world[j] * inverse_bind(skin.joints[j]);
    }
  }
  const std::size_t used = std::min(influences, skin.influences);
  for (std::size_t v = 0; v < rest.size(); ++v) {
    glm::vec3 sum(0.0F);
    float total = 0.0F;
    for (std::size_t i = v * skin.influences; i < v * skin.influences + used && skin.share[i] > 0; ++i) {
      const auto share = static_cast<float>(skin.share[i]) / static_cast<float>(whole);
      sum += share * glm::vec3(matrices[skin.joint[i]] * glm::vec4(rest[v], 1.0F));
      total += share;
    }
    positions[v] = sum / total;
  }
}

}  // namespace semblante

// All 68 FAPs on whole heads: what moves, which way, how far, and what must not move. What is expected is computed from
// the data of the standard and the marked points alone, without the kernel's tables, weights or FAPUs.
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/anatomy/point_lookup.h"
#include "tests/support/posed_face.h"

namespace semblante {
namespace {

using bench::Head;
using bench::PosedFace;
using nlohmann::json;

/// The standard's table, read from the data and not from what is generated of it.
const json& fap_data() {
  static const json data = [] {
    std::ifstream file(std::string(SEMBLANTE_SOURCE_DIR) + "/core/tables/data/faps.json");
    return json::parse(file).at("faps");
  }();
  return data;
}

const json& fap(int number) { return fap_data().at(static_cast<std::size_t>(number - 1)); }

/// The share of a point's displacement that another point takes of it, by the data of the companions: of the point as
/// its leader, and of leaders that follow it themselves.
float share_of_companion(const std::string& point, const std::string& leader) {
  static const json data = [] {
    std::ifstream file(std::string(SEMBLANTE_SOURCE_DIR) + "/core/tables/data/companions.json");
    return json::parse(file).at("companions");
  }();
  float share = 0.0F;
  for (const json& entry : data) {
    if (entry.at("point") != point) continue;
    const std::string follows = entry.at("follows");
    share += entry.at("share").get<float>() * (follows == leader ? 1.0F : share_of_companion(follows, leader));
  }
  return share;
}

/// A head with eyes, teeth and tongue, in one of its methods of weights, with what the tests ask of it.
class Subject {
 public:
  Subject(const Head& head, WeightMethod method)
      : head_(head), face_(head, method), rest_(face_.pose({})), size_(glm::distance(lowest(), highest())) {}

  [[nodiscard]] const std::string& name() const { return head_.name; }
  [[nodiscard]] const Rig& rig() const { return face_.rig(); }
  [[nodiscard]] std::size_t count() const { return rest_.size(); }
  [[nodiscard]] const glm::vec3& rest(std::size_t v) const { return rest_[v]; }
  [[nodiscard]] PartRole role(std::size_t v) const { return face_.role_of(static_cast<std::uint32_t>(v)); }
  /// What counts as nothing: float32 rounding of a head of this size.
  [[nodiscard]] float tolerance() const { return 2e-6F * size_; }

  [[nodiscard]] std::vector<glm::vec3> moved(int number, float value) const {
    return face_.pose(bench::frame_of({{number, value}}));
  }
  [[nodiscard]] std::vector<glm::vec3> moved(const semblante_frame& frame) const { return face_.pose(frame); }

  /// The vertices that are more than two eye distances away from a point and from all that follow it.
  [[nodiscard]] std::vector<bool> far_from(const std::string& point) const {
    std::vector<bool> is_far(count(), true);
    const float near = 2048.0F * unit("ES");
    for (const FeaturePoint& p : head_.points) {
      const std::string id = to_string(p.id);
      if (!p.vertex || (id != point && share_of_companion(id, point) == 0.0F)) continue;
      for (std::size_t v = 0; v < count(); ++v) {
        if (glm::distance(rest_[v], rest_[p.vertex->value()]) <= near) is_far[v] = false;
      }
    }
    return is_far;
  }

  [[nodiscard]] std::optional<std::uint32_t> vertex_of(const std::string& point) const {
    const FeaturePoint* const found = find_point(head_.points, point);
    return found != nullptr && found->vertex ? std::optional(found->vertex->value()) : std::nullopt;
  }
  [[nodiscard]] glm::vec3 position_of(const std::string& point) const {
    if (const FeaturePoint* const found = find_point(head_.points, point)) return found->position;
    ADD_FAILURE() << name() << " has no point " << point;
    return glm::vec3(0.0F);
  }
  [[nodiscard]] const FeaturePointSet& points() const { return head_.points; }

  /// The unit of a translation, in model units: section 2 of the algorithm, by hand.
  [[nodiscard]] float unit(const std::string& name) const {
    const auto gap = [&](const char* a, const char* b, int axis) {
      return position_of(a)[axis] - position_of(b)[axis];
    };
    if (name == "IRISD") return 0.5F * (gap("3.1", "3.3", 1) + gap("3.2", "3.4", 1)) / 1024.0F;
    if (name == "ES") return gap("3.5", "3.6", 0) / 1024.0F;
    if (name == "ENS") return gap("3.5", "9.15", 1) / 1024.0F;
    if (name == "MNS") return gap("9.15", "2.2", 1) / 1024.0F;
    if (name == "MW") return gap("8.3", "8.4", 0) / 1024.0F;
    ADD_FAILURE() << "no unit is called " << name;
    return 0.0F;
  }

 private:
  [[nodiscard]] glm::vec3 lowest() const {
    glm::vec3 result = rest_[0];
    for (const glm::vec3& p : rest_) result = glm::min(result, p);
    return result;
  }
  [[nodiscard]] glm::vec3 highest() const {
    glm::vec3 result = rest_[0];
    for (const glm::vec3& p : rest_) result = glm::max(result, p);
    return result;
  }

  const Head& head_;
  PosedFace face_;
  std::vector<glm::vec3> rest_;
  float size_;
};

/// Our own head always; those of others where their folder is. A mask has neither eyes nor mouth to move.
const std::vector<std::unique_ptr<Subject>>& subjects() {
  static const std::vector<Head> heads = [] {
    std::vector<Head> some = bench::known_heads();
    std::erase_if(some, [](const Head& head) { return head.name == "mediapipe-canonical"; });
    return some;
  }();
  static const std::vector<std::unique_ptr<Subject>> all = [] {
    std::vector<std::unique_ptr<Subject>> some;
    for (const Head& head : heads) some.push_back(std::make_unique<Subject>(head, WeightMethod::paper));
    return some;
  }();
  return all;
}

/// A usual value, and a usual negative one where the FAP has two directions.
std::vector<float> usual_values(int number) {
  std::vector<float> values{fap(number).at("usual")[1].get<float>()};
  if (fap(number).at("directionality") == "B") values.push_back(fap(number).at("usual")[0].get<float>());
  return values;
}

glm::vec3 axis_of(int number) {
  const json& axis = fap(number).at("axis");
  return {axis[0].get<float>(), axis[1].get<float>(), axis[2].get<float>()};
}

bool is_jaw(int number) { return number == 3 || number == 14 || number == 15; }
bool is_of_tongue(const std::string& point) { return point.starts_with("6."); }

/// Right-hand rule, by Rodrigues.
glm::vec3 turned(const glm::vec3& p, const glm::vec3& pivot, const glm::vec3& axis, double angle) {
  const glm::dvec3 d(p - pivot);
  const glm::dvec3 n(axis);
  const glm::dvec3 r =
      d * std::cos(angle) + glm::cross(n, d) * std::sin(angle) + n * glm::dot(n, d) * (1.0 - std::cos(angle));
  return pivot + glm::vec3(r);
}

/// Every vertex that `may_move` refuses is where it was; says which one is not.
template <class MayMove>
void expect_others_still(const Subject& head, const std::vector<glm::vec3>& moved, const char* what, MayMove may_move) {
  std::size_t wrong = 0;
  for (std::size_t v = 0; v < head.count(); ++v) wrong += !may_move(v) && moved[v] != head.rest(v) ? 1 : 0;
  EXPECT_EQ(wrong, 0U) << what << " moved: vertices that should not have";
}

void expect_near(const glm::vec3& a, const glm::vec3& b, float tolerance, const std::string& what) {
  EXPECT_LE(glm::distance(a, b), tolerance)
      << what << ": " << a.x << " " << a.y << " " << a.z << " for " << b.x << " " << b.y << " " << b.z;
}

bool is_lid(const Subject& head, std::size_t v, std::size_t eye) {
  const RigidMotion motion = head.rig().rigid_of_vertex[v];
  return motion == (eye == 0 ? RigidMotion::left_lids : RigidMotion::right_lids);
}

/// A lid that rolls goes down (or up) by what its FAP says, about, on an arc about the eye; only this eye's lids move,
/// and the fold above, which follows.
void check_lid(const Subject& head, int number, float value) {
  const std::string point = fap(number).at("feature_points")[0];
  const std::size_t eye = number % 2 == 1 ? 0 : 1;
  const glm::vec3 displacement = axis_of(number) * value * head.unit("IRISD");
  const std::vector<glm::vec3> moved = head.moved(number, value);
  const auto vertex = head.vertex_of(point);
  ASSERT_TRUE(vertex.has_value()) << point;
  EXPECT_NEAR(moved[*vertex].y - head.rest(*vertex).y, displacement.y, 0.25F * std::abs(displacement.y)) << point;
  const glm::vec3 pivot = eye == 0 ? head.rig().left_eye_pivot : head.rig().right_eye_pivot;
  for (std::size_t v = 0; v < head.count(); ++v) {
    const glm::vec3 d = moved[v] - head.rest(v);
    if (d == glm::vec3(0.0F)) continue;
    EXPECT_TRUE(head.role(v) == PartRole::skin || head.role(v) == PartRole::attached);
    EXPECT_LE(glm::length(d), 1.6F * glm::length(displacement));
    EXPECT_LE(glm::distance(head.rest(v), pivot), 1024.0F * head.unit("ES"));
    if (is_lid(head, v, 1 - eye)) ADD_FAILURE() << "the other eye";
    if (::testing::Test::HasFailure()) return;
  }
}

void check_translation(const Subject& head, int number, float value) {
  if (number >= 19 && number <= 22 && head.rig().lids[number % 2 == 1 ? 0 : 1]) {
    check_lid(head, number, value);
    return;
  }
  const std::string point = fap(number).at("feature_points")[0];
  const glm::vec3 displacement = axis_of(number) * value * head.unit(fap(number).at("unit"));
  const std::vector<glm::vec3> moved = head.moved(number, value);
  const auto vertex = head.vertex_of(point);
  ASSERT_TRUE(vertex.has_value()) << point;
  // Its own point: exactly, along its axis, with its sign.
  expect_near(moved[*vertex] - head.rest(*vertex), displacement, head.tolerance(), point);
  // Every other marked point stays, but for those that the jaw carries: other lip, other eye, brows, ears.
  for (const FeaturePoint& other : head.points()) {
    if (!other.vertex || to_string(other.id) == point) continue;
    const std::uint32_t v = other.vertex->value();
    const bool carried = is_jaw(number) && (head.role(v) == PartRole::tongue || head.role(v) == PartRole::lower_teeth);
    const float share = carried ? 1.0F : share_of_companion(to_string(other.id), point);
    expect_near(moved[v] - head.rest(v), share * displacement, head.tolerance(), to_string(other.id));
  }
  const bool tongue = is_of_tongue(point);
  const std::vector<bool> is_far = head.far_from(point);
  float farthest = 0.0F;
  for (std::size_t v = 0; v < head.count(); ++v) {
    const glm::vec3 d = moved[v] - head.rest(v);
    // Nothing goes farther than the point, nor any other way.
    EXPECT_LE(glm::length(d - glm::dot(d, axis_of(number)) * axis_of(number)), head.tolerance());
    EXPECT_LE(glm::length(d), glm::length(displacement) + head.tolerance());
    EXPECT_GE(glm::dot(d, displacement), -head.tolerance() * glm::length(displacement));
    if (::testing::Test::HasFailure()) return;
    switch (head.role(v)) {
      case PartRole::left_eye:
      case PartRole::right_eye:
      case PartRole::rest:
      case PartRole::body:
        EXPECT_EQ(d, glm::vec3(0.0F));
        break;
      case PartRole::upper_teeth:
        EXPECT_EQ(d, glm::vec3(0.0F));
        break;
      case PartRole::lower_teeth:
        expect_near(d, is_jaw(number) ? displacement : glm::vec3(0.0F), head.tolerance(), "lower teeth");
        break;
      case PartRole::tongue:
        if (!tongue && !is_jaw(number)) {
          EXPECT_EQ(d, glm::vec3(0.0F));
        }
        break;
      case PartRole::attached:
      case PartRole::skin:
        if (tongue) {
          EXPECT_EQ(d, glm::vec3(0.0F));
        }
        // Two eye distances away nothing of it is left; but an ear's points are all there is on the scalp behind it.
        if (!tongue && !is_jaw(number) && !point.starts_with("10.") && is_far[v]) {
          farthest = std::max(farthest, glm::length(d));
        }
        break;
    }
  }
  EXPECT_LE(farthest, 0.05F * glm::length(displacement)) << "far skin";
}

void check_eye_turn(const Subject& head, int number, float value) {
  const bool left = number % 2 == 1;
  const PartRole role = left ? PartRole::left_eye : PartRole::right_eye;
  const glm::vec3 pivot = left ? head.rig().left_eye_pivot : head.rig().right_eye_pivot;
  const std::vector<glm::vec3> moved = head.moved(number, value);
  for (std::size_t v = 0; v < head.count(); ++v) {
    if (head.role(v) != role) continue;
    expect_near(moved[v], turned(head.rest(v), pivot, axis_of(number), value * 1e-5), head.tolerance(), "eye");
    if (::testing::Test::HasFailure()) return;
  }
  // The lids of the eye follow its gaze, and the cornea beneath them.
  const std::size_t eye = left ? 0 : 1;
  expect_others_still(head, moved, "an eye",
                      [&](std::size_t v) { return head.role(v) == role || is_lid(head, v, eye); });
  // In words: the pupil goes to the face's left (+x), or down (-y).
  const auto pupil = head.vertex_of(left ? "3.5" : "3.6");
  ASSERT_TRUE(pupil.has_value());
  const glm::vec3 d = moved[*pupil] - head.rest(*pupil);
  EXPECT_GT((number <= 24 ? d.x : -d.y) * value, 0.0F);
}

void check_thrust(const Subject& head, int number, float value) {
  const PartRole role = number == 27 ? PartRole::left_eye : PartRole::right_eye;
  const glm::vec3 displacement(0.0F, 0.0F, value * head.unit("ES"));
  const std::vector<glm::vec3> moved = head.moved(number, value);
  for (std::size_t v = 0; v < head.count(); ++v) {
    if (head.role(v) != role) continue;
    expect_near(moved[v] - head.rest(v), displacement, head.tolerance(), "eye");
    if (::testing::Test::HasFailure()) return;
  }
  const std::size_t eye = number == 27 ? 0 : 1;
  expect_others_still(head, moved, "an eye",
                      [&](std::size_t v) { return head.role(v) == role || is_lid(head, v, eye); });
}

void check_pupil(const Subject& head, int number, float value) {
  const bool left = number == 29;
  const PartRole role = left ? PartRole::left_eye : PartRole::right_eye;
  const glm::dvec3 pivot(left ? head.rig().left_eye_pivot : head.rig().right_eye_pivot);
  const auto& iris = head.rig().irises[left ? 0 : 1];
  ASSERT_TRUE(iris.has_value());
  // By the standard's neutral face the pupil is a third of the iris, whose diameter is IRISD0.
  const double growth = 0.5 * value * head.unit("IRISD");
  const double pupil_radius = 512.0 / 3.0 * head.unit("IRISD");
  EXPECT_NEAR(iris->pupil_radius, pupil_radius, 1e-4 * pupil_radius);
  const double iris_radius = iris->iris_radius;
  ASSERT_GE(pupil_radius + growth, 0.1 * pupil_radius);
  const std::vector<glm::vec3> moved = head.moved(number, value);
  std::size_t grown = 0;
  double farthest = 0.0;
  const glm::dvec3 axis(iris->axis);
  for (std::size_t v = 0; v < head.count(); ++v) {
    if (moved[v] == head.rest(v)) continue;
    ASSERT_EQ(head.role(v), role) << "nothing but this eye";
    const auto polar = [&](const glm::vec3& p) {
      const glm::dvec3 d = glm::dvec3(p) - pivot;
      return std::pair(glm::length(d - glm::dot(d, axis) * axis), glm::dot(d, axis));
    };
    const auto [r, along] = polar(head.rest(v));
    const auto [to, to_along] = polar(moved[v]);
    ASSERT_GT(along, 0.0) << "the back of the eye";
    ASSERT_LT(r, iris_radius) << "the white of the eye";
    const double expected = r < pupil_radius ? r * (pupil_radius + growth) / pupil_radius
                                             : r + growth * (iris_radius - r) / (iris_radius - pupil_radius);
    ASSERT_NEAR(to, expected, head.tolerance());
    ASSERT_LT(to, iris_radius);
    // It slides along the iris: off it by no more than a tenth of the way it went.
    ASSERT_LT(std::abs(to_along - along), 0.6 * std::abs(to - r) + head.tolerance());
    grown += (to - r) * growth > 0.0 ? 1 : 0;
    farthest = std::max(farthest, std::abs(to - r));
  }
  EXPECT_GE(grown, 8U) << "an iris is a ring of vertices at least";
  EXPECT_GE(farthest, 0.3 * std::abs(growth));
}

void check_roll(const Subject& head, float value) {
  const std::vector<glm::vec3> moved = head.moved(47, value);
  expect_others_still(head, moved, "tongue", [&](std::size_t v) { return head.role(v) == PartRole::tongue; });
  ASSERT_TRUE(head.rig().tongue.has_value());
  const Tongue& tongue = *head.rig().tongue;
  for (const char* border : {"6.3", "6.4"}) {
    const auto v = head.vertex_of(border);
    ASSERT_TRUE(v.has_value()) << border;
    const glm::vec3 d = head.rest(*v) - tongue.origin;
    const double u = std::abs(glm::dot(d, tongue.left));
    const double height = glm::dot(d, tongue.up);
    // The border turns by the whole angle, on an arc as long as the tongue is half wide.
    EXPECT_NEAR(u, tongue.half_width, 0.02 * u);
    const double angle = value * 1e-5 * std::min(1.0, u / tongue.half_width);
    const double radius = tongue.half_width / (value * 1e-5);
    const double arc = std::sin(angle) * (radius - height);
    const double rise = radius - std::cos(angle) * (radius - height);
    const double straight = std::max(0.0, u - tongue.half_width);
    const glm::vec3 to = moved[*v] - tongue.origin;
    EXPECT_NEAR(std::abs(glm::dot(to, tongue.left)), arc + straight * std::cos(angle), 2e-3 * u) << border;
    EXPECT_NEAR(glm::dot(to, tongue.up), rise + straight * std::sin(angle), 2e-3 * u) << border;
    EXPECT_GT(moved[*v].y, head.rest(*v).y + 0.2F * tongue.half_width) << "both borders go up";
    EXPECT_LT(std::abs(moved[*v].x), std::abs(head.rest(*v).x)) << "and inwards";
  }
  // The middle line stays, and nothing passes through it to the other side.
  for (std::size_t v = 0; v < head.count(); ++v) {
    if (moved[v] == head.rest(v)) continue;
    const float x = head.rest(v).x;
    if (std::abs(x) < head.tolerance()) {
      EXPECT_LT(glm::distance(moved[v], head.rest(v)), 20.0F * head.tolerance()) << x << " of " << tongue.origin.x;
    }
    if (std::abs(x) > 0.02F * tongue.half_width) {
      EXPECT_GT(moved[v].x * x, 0.0F);
    }
    if (::testing::Test::HasFailure()) return;
  }
}

void check_head_turn(const Subject& head, int number, float value) {
  const std::vector<glm::vec3> moved = head.moved(number, value);
  const glm::vec3 pivot = head.position_of("7.1");
  for (std::size_t v = 0; v < head.count(); ++v) {
    // A share of the rotation: normalized linear interpolation of quaternions.
    const double share = head.rig().turn_of_vertex.empty() ? 1.0 : head.rig().turn_of_vertex[v] / 255.0;
    const double half = 0.5 * value * 1e-5;
    const double angle = 2.0 * std::atan2(share * std::sin(half), (1.0 - share) + share * std::cos(half));
    expect_near(moved[v], turned(head.rest(v), pivot, axis_of(number), angle), 2.0F * head.tolerance(), "head");
    if (::testing::Test::HasFailure()) return;
  }
  const auto nose = head.vertex_of("9.3");
  const auto crown = head.vertex_of("11.4");
  ASSERT_TRUE(nose && crown);
  // Down, to the face's left, with the crown to its right.
  if (number == 48) {
    EXPECT_LT((moved[*nose].y - head.rest(*nose).y) * value, 0.0F);
  }
  if (number == 49) {
    EXPECT_GT((moved[*nose].x - head.rest(*nose).x) * value, 0.0F);
  }
  if (number == 50) {
    EXPECT_LT((moved[*crown].x - head.rest(*crown).x) * value, 0.0F);
  }
}

TEST(FapTable, EveryLowLevelFapHasItsEffectAndNoOther) {
  for (const auto& head : subjects()) {
    std::array<int, 69> checked{};
    for (int number = 3; number <= 68; ++number) {
      for (const float value : usual_values(number)) {
        SCOPED_TRACE(head->name() + ", FAP " + std::to_string(number) + " = " + std::to_string(value));
        const std::string kind = fap(number).at("kind");
        if (number == 27 || number == 28) {
          check_thrust(*head, number, value);
        } else if (kind == "translation") {
          check_translation(*head, number, value);
        } else if (kind == "scale") {
          check_pupil(*head, number, value);
        } else if (number == 47) {
          check_roll(*head, value);
        } else if (number <= 26) {
          check_eye_turn(*head, number, value);
        } else {
          check_head_turn(*head, number, value);
        }
        ++checked[static_cast<std::size_t>(number)];
        if (HasFailure()) return;
      }
    }
    for (int number = 3; number <= 68; ++number) {
      EXPECT_EQ(checked[static_cast<std::size_t>(number)], fap(number).at("directionality") == "B" ? 2 : 1) << number;
    }
  }
}

TEST(FapTable, EveryVisemeAndExpressionMovesTheSkinAloneAndTheJawWithItsTeeth) {
  for (const auto& head : subjects()) {
    for (int entry = 1; entry < 15 + 6; ++entry) {
      const bool viseme = entry < 15;
      const int number = viseme ? entry : entry - 14;
      SCOPED_TRACE(head->name() + (viseme ? ", viseme " : ", expression ") + std::to_string(number));
      const auto byte = static_cast<std::uint8_t>(number);
      const std::vector<glm::vec3> moved =
          head->moved(viseme ? bench::frame_of(byte, 0) : bench::frame_of(std::uint8_t{0}, byte));
      const std::uint32_t jaw = *head->vertex_of("2.1");
      const glm::vec3 jaw_motion = moved[jaw] - head->rest(jaw);
      float farthest = 0.0F;
      for (std::size_t v = 0; v < head->count(); ++v) {
        const glm::vec3 d = moved[v] - head->rest(v);
        const PartRole role = head->role(v);
        if (role == PartRole::lower_teeth) expect_near(d, jaw_motion, head->tolerance(), "lower teeth");
        if (role == PartRole::upper_teeth || role == PartRole::left_eye || role == PartRole::right_eye ||
            role == PartRole::rest) {
          EXPECT_EQ(d, glm::vec3(0.0F));
        }
        if (role == PartRole::skin) farthest = std::max(farthest, glm::length(d));
        if (HasFailure()) return;
      }
      EXPECT_GT(farthest, 20.0F * head->unit("MNS")) << "it can be seen";
    }
    // Silence and none.
    EXPECT_EQ(head->moved(bench::frame_of(std::uint8_t{0}, std::uint8_t{0})), head->moved({}));
  }
}

// Lashes and brows hang on the skin: where they touch it they go with it, vertex by vertex.
TEST(FapTable, AttachedPartsFollowTheSkinTheyTouch) {
  for (const auto& head : subjects()) {
    std::map<std::array<float, 3>, std::vector<std::uint32_t>> skin_at;
    for (std::uint32_t v = 0; v < head->count(); ++v) {
      if (head->role(v) == PartRole::skin) skin_at[{head->rest(v).x, head->rest(v).y, head->rest(v).z}].push_back(v);
    }
    std::vector<std::pair<std::uint32_t, const std::vector<std::uint32_t>*>> touching;
    for (std::uint32_t v = 0; v < head->count(); ++v) {
      if (head->role(v) != PartRole::attached) continue;
      const auto skin = skin_at.find({head->rest(v).x, head->rest(v).y, head->rest(v).z});
      if (skin != skin_at.end()) touching.emplace_back(v, &skin->second);
    }
    if (head->name() == "ict-facekit") {
      EXPECT_GE(touching.size(), 200U) << "lashes, for one";
    }
    for (const int number : {19, 20, 21, 22, 33, 34}) {
      const std::vector<glm::vec3> moved = head->moved(number, 300.0F);
      std::size_t following = 0;
      for (const auto& [v, skin] : touching) {
        float nearest = 1e30F;
        for (const std::uint32_t s : *skin) nearest = std::min(nearest, glm::distance(moved[v], moved[s]));
        ASSERT_LE(nearest, head->tolerance()) << head->name() << " " << number;
        following += moved[v] != head->rest(v) ? 1 : 0;
      }
      if (number <= 22 && !touching.empty()) {
        EXPECT_GE(following, 10U) << head->name() << " " << number;
      }
    }
  }
}

}  // namespace
}  // namespace semblante

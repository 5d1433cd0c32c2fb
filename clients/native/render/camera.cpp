#include "clients/native/render/camera.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace semblante::render {
namespace {

constexpr float margin = 1.06F;

/// Unit vector from the head towards the camera.
glm::vec3 direction_of(View view) {
  switch (view) {
    case View::front:
      return {0, 0, 1};
    case View::left:
      return {1, 0, 0};
    case View::right:
      return {-1, 0, 0};
    case View::three_quarter:
      return glm::normalize(glm::vec3(0.62F, 0.08F, 0.78F));
    case View::three_quarter_right:
      return glm::normalize(glm::vec3(-0.62F, 0.08F, 0.78F));
    case View::below:
      return glm::normalize(glm::vec3(0, -0.64F, 0.77F));
    case View::above:
      return glm::normalize(glm::vec3(0, 0.64F, 0.77F));
    case View::back:
      return {0, 0, -1};
  }
  return {0, 0, 1};
}

template <class Visit>
void for_each_corner(const Box& box, Visit visit) {
  for (int corner = 0; corner < 8; ++corner) {
    visit(glm::vec3((corner & 1) != 0 ? box.max.x : box.min.x, (corner & 2) != 0 ? box.max.y : box.min.y,
                    (corner & 4) != 0 ? box.max.z : box.min.z));
  }
}

Box grown(Box box, glm::vec3 by) { return {box.min - by, box.max + by}; }

Box around(glm::vec3 centre, glm::vec3 below, glm::vec3 above) { return {centre - below, centre + above}; }

std::optional<Subjects> from_points(const Box& all, std::span<const FeaturePoint> points) {
  Subjects found;
  found.all = all;
  for (const FeaturePoint& point : points) {
    const int group = group_of(point.id);
    if (group == 3) {
      found.eyes.add(point.position);
    }
    if (group == 8 || (group == 2 && number_of(point.id) != 1 && number_of(point.id) < 10)) {
      found.mouth.add(point.position);
    }
    if (group == 2 || group == 3 || group == 4 || group == 5 || group == 8 || group == 9) {
      found.face.add(point.position);
    }
  }
  if (found.eyes.empty() || found.mouth.empty() || found.eyes.size().x <= 0 || found.mouth.size().x <= 0) {
    return std::nullopt;
  }
  const float eyes = found.eyes.size().x;
  const float mouth = found.mouth.size().x;
  found.eyes = grown(found.eyes, {0.18F * eyes, 0.16F * eyes, 0});
  found.mouth = grown(found.mouth, {0.40F * mouth, 0.22F * mouth, 0});
  // The brows are the topmost points marked on every face; some forehead above shows their motion.
  found.face = grown(found.face, {0.12F * eyes, 0.12F * eyes, 0});
  found.face.max.y += 0.22F * eyes;
  found.face.min.y -= 0.10F * eyes;
  return found;
}

Subjects from_proportions(const Box& all, glm::vec3 between_eyes, float eye_distance) {
  const float d = eye_distance;
  Subjects found;
  found.all = all;
  found.eyes = around(between_eyes, {1.0F * d, 0.45F * d, 0.2F * d}, {1.0F * d, 0.5F * d, 0.2F * d});
  found.face = around(between_eyes, {1.35F * d, 2.15F * d, 0.3F * d}, {1.35F * d, 1.25F * d, 0.5F * d});
  found.mouth = around(between_eyes - glm::vec3(0, 1.12F * d, 0), {0.75F * d, 0.6F * d, 0.1F * d},
                       {0.75F * d, 0.5F * d, 0.3F * d});
  return found;
}

}  // namespace

void Box::add(glm::vec3 point) {
  min = glm::min(min, point);
  max = glm::max(max, point);
}

const Box& Subjects::operator[](Subject subject) const {
  switch (subject) {
    case Subject::all:
      return all;
    case Subject::face:
      return face;
    case Subject::eyes:
      return eyes;
    case Subject::mouth:
      return mouth;
  }
  return all;
}

glm::mat4 Camera::view() const { return glm::lookAt(eye, target, glm::vec3(0, 1, 0)); }

glm::mat4 Camera::projection(float aspect) const {
  return glm::perspective(vertical_field, aspect, near_plane, far_plane);
}

Camera frame_box(const Box& subject, const Box& scene, View view, float aspect) {
  Camera camera;
  camera.target = subject.centre();
  const glm::vec3 towards = direction_of(view);
  const glm::mat3 axes(glm::lookAt(glm::vec3(0), -towards, glm::vec3(0, 1, 0)));
  const float slope_y = std::tan(camera.vertical_field / 2) / margin;
  const float slope_x = slope_y * aspect;
  // The largest of the distances required by each corner: |x| <= slope * (distance - depth towards the camera).
  float distance = 1e-6F;
  for_each_corner(subject, [&](glm::vec3 corner) {
    const glm::vec3 local = axes * (corner - camera.target);
    distance = std::max({distance, std::abs(local.x) / slope_x + local.z, std::abs(local.y) / slope_y + local.z});
  });
  camera.eye = camera.target + towards * distance;
  float nearest = distance;
  float farthest = distance;
  for_each_corner(scene, [&](glm::vec3 corner) {
    const float depth = glm::dot(camera.eye - corner, towards);
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  });
  const float reach = glm::length(scene.size());
  camera.near_plane = std::max(nearest - 0.1F * reach, 0.01F * distance);
  camera.far_plane = farthest + 0.2F * reach;
  return camera;
}

Subjects find_subjects(const Box& all, std::span<const FeaturePoint> points,
                       const std::optional<std::array<Box, 2>>& eyes) {
  if (auto found = from_points(all, points)) {
    return *found;
  }
  if (eyes) {
    const glm::vec3 a = (*eyes)[0].centre();
    const glm::vec3 b = (*eyes)[1].centre();
    return from_proportions(all, (a + b) * 0.5F, glm::length(a - b));
  }
  // Only a head: its eyes are at half its height and about 0.42 of its width apart.
  const glm::vec3 size = all.size();
  return from_proportions(all, {all.centre().x, all.centre().y, all.max.z - 0.2F * size.z}, 0.4F * size.x);
}

std::optional<View> parse_view(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, View>, 8> names = {{
      {"front", View::front},
      {"left", View::left},
      {"right", View::right},
      {"three-quarter", View::three_quarter},
      {"three-quarter-right", View::three_quarter_right},
      {"below", View::below},
      {"above", View::above},
      {"back", View::back},
  }};
  const auto* const found = std::find_if(names.begin(), names.end(), [&](const auto& n) { return n.first == name; });
  return found == names.end() ? std::nullopt : std::optional(found->second);
}

std::optional<Subject> parse_subject(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, Subject>, 4> names = {
      {{"all", Subject::all}, {"face", Subject::face}, {"eyes", Subject::eyes}, {"mouth", Subject::mouth}}};
  const auto* const found = std::find_if(names.begin(), names.end(), [&](const auto& n) { return n.first == name; });
  return found == names.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace semblante::render

#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "core/types/feature_points.h"

namespace semblante::render {

/// An axis-aligned box in model units; empty until something is put into it.
struct Box {
  glm::vec3 min{std::numeric_limits<float>::max()};
  glm::vec3 max{std::numeric_limits<float>::lowest()};

  [[nodiscard]] bool empty() const { return min.x > max.x; }
  [[nodiscard]] glm::vec3 centre() const { return (min + max) * 0.5F; }
  [[nodiscard]] glm::vec3 size() const { return max - min; }
  void add(glm::vec3 point);
};

/// The direction of the camera. Sides are the face's own: `left` looks at its left ear, with the nose on the left of
/// the image.
enum class View { front, left, right, three_quarter, three_quarter_right, below, above, back };
/// The part of the head in the image.
enum class Subject { all, face, eyes, mouth };

/// The bounding boxes of the subjects of one head.
struct Subjects {
  Box all, face, eyes, mouth;
  [[nodiscard]] const Box& operator[](Subject subject) const;
};

struct Camera {
  glm::vec3 eye{0.0F};
  glm::vec3 target{0.0F};
  float vertical_field = 0.42F;  ///< radians
  float near_plane = 0.1F;
  float far_plane = 100.0F;

  [[nodiscard]] glm::mat4 view() const;
  [[nodiscard]] glm::mat4 projection(float aspect) const;
};

/// A camera that shows all of `subject` from `view` with a margin; the near and far planes enclose all of `scene`.
Camera frame_box(const Box& subject, const Box& scene, View view, float aspect);

/// Finds the subjects by the feature points if there are enough of them, else by the eyeballs (a box each), else by the
/// proportions of a head that fills `all`.
Subjects find_subjects(const Box& all, std::span<const FeaturePoint> points,
                       const std::optional<std::array<Box, 2>>& eyes);

/// "front", "left", "right", "three-quarter", "three-quarter-right", "below", "above", "back".
std::optional<View> parse_view(std::string_view name);
/// "all", "face", "eyes", "mouth".
std::optional<Subject> parse_subject(std::string_view name);

}  // namespace semblante::render

#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "core/kernel/semblante_kernel.h"

namespace semblante::testing {

/// A face like a mesh out of a decoder: neighbours in the order share most of their points; eyes, irises and a tongue
/// come in stretches, some end to end. No framework: other machines' tests use it too.
class RandomFace {
 public:
  enum PoseKind : unsigned { neutral, points, head, eyes, pupils, tongue, lids, everything, other, pose_kinds };

  RandomFace(std::uint32_t vertices, unsigned seed) : random_(seed) {
    std::vector<std::uint8_t> set;
    std::uint8_t part = SEMBLANTE_RIGID_NONE;
    std::uint8_t turn = SEMBLANTE_TURN_FULL;
    for (std::uint32_t v = 0; v < vertices; ++v) {
      if (v % 37 == 0) {
        static constexpr std::uint8_t parts[] = {0, 0, 0, 1, 3, 1, 2, 4, 4, 255, 200, 128, 5, 6};
        part = parts[random_() % 14];
        static constexpr std::uint8_t turns[] = {255, 255, 255, 0, 90};
        turn = turns[random_() % 5];
      }
      if (v == 0 || random_() % 3 == 0) change(set);
      for (int i = 0; i < 3; ++i) rest_.push_back(unit());
      for (const std::uint8_t point : set) {
        points_.push_back(point);
        weights_.push_back(0.5F + unit() / 2);
      }
      offsets_.push_back(static_cast<std::uint32_t>(points_.size()));
      rigid_.push_back(random_() % 50 == 0 ? std::uint8_t{0} : part);
      turn_.push_back(turn);
    }
    face_ = {vertices, rest_.data(), offsets_.data(), points_.data(), weights_.data(), rigid_.data(), turn_.data()};
  }
  RandomFace(const RandomFace&) = delete;
  RandomFace& operator=(const RandomFace&) = delete;

  const semblante_face& view() const { return face_; }

  std::uint32_t influences(std::uint32_t vertex, std::uint8_t point) const {
    return static_cast<std::uint32_t>(
        std::count(points_.begin() + offsets_[vertex], points_.begin() + offsets_[vertex + 1], point));
  }

  /// The vertices that turn with the head.
  std::uint32_t turning() const {
    return static_cast<std::uint32_t>(turn_.size()) -
           static_cast<std::uint32_t>(std::count(turn_.begin(), turn_.end(), std::uint8_t{0}));
  }

  void swap_two_points_of_a_row() {
    std::uint32_t v = 0;
    while (offsets_[v + 1] - offsets_[v] < 2) ++v;
    std::swap(points_[offsets_[v]], points_[offsets_[v] + 1]);
  }

  /// The same for the same kind. Half of the points stand still.
  semblante_pose pose(unsigned kind) const {
    std::mt19937 random(77);
    const auto number = [&random] { return static_cast<float>(random() % 2001) / 1000.0F - 1.0F; };
    semblante_pose p{};
    p.head_rotation[3] = p.eye_rotation[0][3] = p.eye_rotation[1][3] = 1.0F;
    for (int eye = 0; eye < 2; ++eye) {
      p.eye_pivot[eye][0] = eye == 0 ? 0.3F : -0.3F;
      p.iris[eye] = {{0.0F, 0.0F, 1.0F}, 0.2F, 0.6F, -0.4F};
    }
    for (semblante_lids& of_eye : p.lids) {
      of_eye = {{0.0F, 0.0F, 1.0F}, 0.7F, 0.2F, {0.75F, 0.25F}, {}, 0.25F};
      for (float& radius : of_eye.ball) radius = 0.4F;
    }
    p.head_pivot[1] = -0.5F;
    p.tongue = {{0.0F, -0.2F, 0.1F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, 0.4F, 1.0F};
    const bool all = kind == everything || kind == other;
    if (kind == points || all) {
      for (int fp = kind == other ? 1 : 0; fp < SEMBLANTE_FP_COUNT; fp += 2) {
        for (int i = 0; i < 3; ++i) p.fp[fp * 3 + i] = 0.1F * number();
      }
    }
    if (kind == head || all) {
      const float half[4] = {0.1F, kind == other ? -0.3F : 0.3F, 0.1F, 0.943398F};
      std::copy(half, half + 4, p.head_rotation);
    }
    if (kind == eyes || all) {
      p.eye_rotation[0][1] = 0.28F;
      p.eye_rotation[0][3] = 0.96F;
      p.eye_translation[1][2] = 0.05F;
    }
    if (kind == pupils || all) p.pupil_growth[1] = 0.1F;
    if (kind == tongue || all) p.tongue_roll = 0.7F;
    if (kind == lids || all) {
      p.lid_closure[0][0] = 0.9F;
      p.lid_closure[1][1] = 0.4F;
    }
    return p;
  }

 private:
  float unit() { return static_cast<float>(random_() % 20001) / 10000.0F - 1.0F; }

  /// One point more or fewer; now and then all others, or none.
  void change(std::vector<std::uint8_t>& set) {
    const unsigned what = random_() % 12;
    if (what == 0) set.clear();
    if (what <= 1) {
      for (unsigned i = random_() % 18; i > 0; --i) set.push_back(static_cast<std::uint8_t>(random_() % 84));
    } else if (what < 7 && !set.empty()) {
      set.erase(set.begin() + static_cast<std::ptrdiff_t>(random_() % set.size()));
    } else {
      set.push_back(static_cast<std::uint8_t>(random_() % 84));
    }
    std::sort(set.begin(), set.end());
    set.erase(std::unique(set.begin(), set.end()), set.end());
  }

  std::mt19937 random_;
  std::vector<float> rest_, weights_;
  std::vector<std::uint32_t> offsets_{0};
  std::vector<std::uint8_t> points_, rigid_, turn_;
  semblante_face face_{};
};

}  // namespace semblante::testing

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/kernel/semblante_kernel.h"

namespace semblante::testing {

/// A face of some 240 vertices that has one of everything: skin with a UV seam and a hard edge, a neck below it, two
/// eyes with irises and lids, a tongue, vertices without influence; and the frames that exercise it. Coordinates are
/// about 1, FAPUs about 1/1000.
struct GoldenFace {
  std::vector<float> rest, normals;  ///< #V by 3
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> offsets{0};
  std::vector<std::uint8_t> points, rigid, turn;
  std::vector<float> weights;
  std::vector<float> visemes = std::vector<float>(15 * 84 * 3);
  std::vector<float> expressions = std::vector<float>(7 * 84 * 3);
  std::vector<semblante_companion> companions;
  semblante_rig rig{};

  GoldenFace();
  GoldenFace(const GoldenFace&) = delete;
  GoldenFace& operator=(const GoldenFace&) = delete;
  [[nodiscard]] semblante_face view() const;
};

struct GoldenFrame {
  std::string name;
  semblante_frame frame{};
  bool jaw_takes_lip = false;
};

/// Every group of FAPs, visemes, expressions, what overlaps, and each motion of a part.
std::vector<GoldenFrame> golden_frames();

/// Pairs of frames, by name, whose middle is a golden frame too.
std::vector<std::array<std::string, 2>> golden_middles();

}  // namespace semblante::testing

#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "core/kernel/semblante_kernel.h"
#include "core/tables/mpeg4.h"
#include "tests/unit/kernel/kernel_rig.h"

namespace semblante::testing {

/// A random face, rig and frame, from a seed.
struct RandomCase {
  TestRig rig;
  std::vector<float> rest;
  std::vector<std::uint32_t> offsets{0};
  std::vector<std::uint8_t> points;
  std::vector<float> weights;
  std::vector<std::uint8_t> rigid;
  semblante_face face{};
  std::mt19937 random;

  explicit RandomCase(unsigned seed) : random(seed) {
    std::uniform_real_distribution<float> unit(-1, 1);
    for (auto* table : {&rig.viseme, &rig.expression}) {
      for (std::size_t i = 84 * 3; i < table->size(); i += 3) {  // entry 0 of both is rest
        if (random() % 3 == 0) {
          for (std::size_t k = 0; k < 3; ++k) (*table)[i + k] = unit(random);
        }
      }
    }
    for (float& f : rig.rig.fapu) f = 0.002F + 0.001F * unit(random);
    rig.rig.viseme_share = 0.85F;
    for (float& p : rig.rig.head_pivot) p = 3 * unit(random);
    for (auto& pivot : rig.rig.eye_pivot) {
      for (float& p : pivot) p = unit(random);
    }
    for (auto& iris : rig.rig.iris) {
      iris = {{unit(random), unit(random), unit(random)}, 1.0F + 0.5F * unit(random), 4.0F + unit(random), 0};
      const float length =
          std::sqrt(iris.axis[0] * iris.axis[0] + iris.axis[1] * iris.axis[1] + iris.axis[2] * iris.axis[2]);
      for (float& a : iris.axis) a /= length;
      iris.bend = 0.1F * unit(random);
    }
    const float tilt = unit(random);
    rig.rig.tongue = {{unit(random), unit(random), unit(random)},
                      {std::cos(tilt), 0, -std::sin(tilt)},
                      {0, 1, 0},
                      2.0F + unit(random),
                      1.0F + 0.5F * unit(random)};
    const std::uint32_t count = 200;
    for (std::uint32_t v = 0; v < count; ++v) {
      for (int i = 0; i < 3; ++i) rest.push_back(5 * unit(random));
      const unsigned part = random() % 7;  // none, eyes, irises, all of the tongue, some share of it
      rigid.push_back(static_cast<std::uint8_t>(part < 5 ? part : part == 5 ? 255 : 128 + random() % 128));
      const unsigned entries = random() % 8;
      float sum = 0;
      for (unsigned e = 0; e < entries; ++e) {
        points.push_back(static_cast<std::uint8_t>(random() % 84));
        weights.push_back(0.1F + std::abs(unit(random)));
        sum += weights.back();
      }
      for (unsigned e = 0; e < entries; ++e) weights[weights.size() - 1 - e] /= sum;
      offsets.push_back(static_cast<std::uint32_t>(points.size()));
    }
    face = {count, rest.data(), offsets.data(), points.data(), weights.data(), rigid.data(), nullptr};
  }

  semblante_frame frame() {
    std::uniform_real_distribution<float> unit(-1, 1);
    semblante_frame f{};
    f.viseme1 = static_cast<std::uint8_t>(random() % 15);
    f.viseme2 = static_cast<std::uint8_t>(random() % 15);
    f.viseme_blend = static_cast<std::uint8_t>(random() % 64);
    f.expression1 = static_cast<std::uint8_t>(random() % 7);
    f.intensity1 = static_cast<std::uint8_t>(random() % 64);
    f.expression2 = static_cast<std::uint8_t>(random() % 7);
    f.intensity2 = static_cast<std::uint8_t>(random() % 64);
    for (std::size_t n = 3; n <= 68; ++n) {
      if (random() % 4 == 0) f.fap[n] = unit(random) * static_cast<float>(mpeg4::fap(n).usual_max);
      if (n == 29 || n == 30) f.fap[n] *= 2.0F;  // far enough to show; some beyond what a pupil can
    }
    return f;
  }
};

}  // namespace semblante::testing

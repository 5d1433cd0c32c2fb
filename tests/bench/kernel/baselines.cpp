#include "tests/bench/kernel/baselines.h"

#include <cmath>
#include <cstring>

namespace semblante::bench {
namespace {

struct Matrix {
  float m[9];
};

Matrix matrix_of(const float* q) {
  const float x = q[0], y = q[1], z = q[2], w = q[3];
  return {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), 2 * (x * y + w * z),
           1 - 2 * (x * x + z * z), 2 * (y * z - w * x), 2 * (x * z - w * y), 2 * (y * z + w * x),
           1 - 2 * (x * x + y * y)}};
}

/// The share of a rotation that a vertex of the neck has.
Matrix part_of(const float* q, std::uint8_t turn) {
  const float share = static_cast<float>(turn) / SEMBLANTE_TURN_FULL;
  const float side = q[3] < 0 ? -share : share;
  float r[4] = {side * q[0], side * q[1], side * q[2], 1 - share + side * q[3]};
  const float length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
  for (float& number : r) number /= length;
  return matrix_of(r);
}

/// x, y, z turned about a pivot.
inline void turn(const Matrix& r, const float* pivot, float& x, float& y, float& z) {
  const float a = x - pivot[0], b = y - pivot[1], c = z - pivot[2];
  x = r.m[0] * a + r.m[1] * b + r.m[2] * c + pivot[0];
  y = r.m[3] * a + r.m[4] * b + r.m[5] * c + pivot[1];
  z = r.m[6] * a + r.m[7] * b + r.m[8] * c + pivot[2];
}

}  // namespace

void scalar_deform(const semblante_face& face, const semblante_pose& pose, float* positions) {
  const Matrix head = matrix_of(pose.head_rotation);
  const Matrix eyes[2] = {matrix_of(pose.eye_rotation[0]), matrix_of(pose.eye_rotation[1])};
  for (std::uint32_t v = 0; v < face.vertex_count; ++v) {
    float x = face.rest[v * 3], y = face.rest[v * 3 + 1], z = face.rest[v * 3 + 2];
    for (std::uint32_t k = face.row_offsets[v]; k < face.row_offsets[v + 1]; ++k) {
      const float weight = face.row_weights[k];
      const float* d = pose.fp + std::size_t{face.row_points[k]} * 3;
      x += weight * d[0];
      y += weight * d[1];
      z += weight * d[2];
    }
    if (face.rigid[v] != SEMBLANTE_RIGID_NONE && face.rigid[v] < SEMBLANTE_RIGID_COUNT) {
      const int eye = face.rigid[v] % 2 == 1 ? 0 : 1;
      turn(eyes[eye], pose.eye_pivot[eye], x, y, z);
    }
    if (face.turn[v] == SEMBLANTE_TURN_FULL) {
      turn(head, pose.head_pivot, x, y, z);
    } else if (face.turn[v] != 0) {
      turn(part_of(pose.head_rotation, face.turn[v]), pose.head_pivot, x, y, z);
    }
    positions[v * 3] = x;
    positions[v * 3 + 1] = y;
    positions[v * 3 + 2] = z;
  }
}

#if defined(__x86_64__)
__attribute__((target_clones("avx2", "default")))
#endif
#if defined(__GNUC__) && !defined(__clang__)
__attribute__((optimize("O3")))
#endif
static std::uint64_t
sum(const std::byte* from, std::size_t words) {
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < words; ++i) {
    std::uint64_t word = 0;
    std::memcpy(&word, from + i * 8, 8);
    total += word;
  }
  return total;
}

std::uint64_t stream(const std::byte* read, std::size_t read_bytes, std::byte* write, std::size_t written) {
  std::memcpy(write, read, written);
  return sum(read + written, (read_bytes - written) / 8);
}

}  // namespace semblante::bench

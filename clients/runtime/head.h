#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <new>
#include <vector>

#include "clients/runtime/semblante.h"
#include "protocol/cpp/rig_kernel.h"
#include "protocol/cpp/weights_format.h"

namespace semblante::runtime {

struct FreeAligned {
  void operator()(void* memory) const { ::operator delete (memory, std::align_val_t{64}); }
};

/// The poses of the frames that a player shows one after the other: each is evaluated once.
class EvaluatedPoses {
 public:
  /// The pose of `frame`, evaluated with `rig`, which differs from call to call in its viseme share only. The last four
  /// results stay valid.
  const semblante_pose& of(const semblante_rig& rig, const semblante_frame& frame);
  /// The number of the evaluation that gave a result of `of`: equal numbers are equal poses.
  [[nodiscard]] std::uint64_t number_of(const semblante_pose& pose) const;

 private:
  struct Entry {
    std::uint64_t number = 0, used = 0;  ///< 0: empty
    float viseme_share = 0;
    semblante_frame frame{};
    semblante_pose pose{};
  };
  std::array<Entry, 4> entries_;
  std::uint64_t evaluations_ = 0, uses_ = 0;
};

/// What decides the pose that a player set.
struct ShownPose {
  std::array<std::uint64_t, 4> poses{};
  std::array<float, 3> spans{};
  float t = 0;
  bool operator==(const ShownPose&) const = default;
};

}  // namespace semblante::runtime

/// Owned by the caller through the opaque handle. `rig` and `face` point into the vectors beside them.
struct semblante_head {
  std::vector<float> rest;
  std::vector<float> uvs;            ///< #V by 2 or empty
  std::vector<std::uint8_t> colors;  ///< #V by 3 or empty
  semblante::KernelRig kernel;
  semblante::InfluenceTable table;
  std::vector<std::uint8_t> points;
  semblante_rig rig{};
  semblante_face face{};
  semblante_pose pose{};
  std::unique_ptr<void, semblante::runtime::FreeAligned> prepared_memory;
  const semblante_prepared_face* prepared = nullptr;  ///< null: no vertices are computed
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> joined;             ///< empty: no normals are computed
  std::vector<float> own_normals, rest_normals;  ///< #V by 3: of the mesh, and from its triangles; else empty
  semblante_triangles triangles{};
  std::unique_ptr<semblante::runtime::EvaluatedPoses> evaluated =
      std::make_unique<semblante::runtime::EvaluatedPoses>();
  semblante::runtime::ShownPose shown;  ///< poses are 0: the pose is not a player's
};

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/expressions/kernel_rig.h"
#include "core/geometry/surface.h"
#include "core/parametrize/parametrize.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante::bench {

/// A head as its makers left it, with its points where they marked them.
struct Head {
  std::string name;
  Model model;
  Surface surface;
  FeaturePointSet points;
};

/// Our own head, then those of the folder of real heads where there is one. Throws where a file cannot be read.
std::vector<Head> known_heads();
Head sample_head();
/// A head as the server reads it: turned to the MPEG-4 axes by its file of points. Throws likewise.
Head read_head(const std::filesystem::path& model, const std::filesystem::path& points);
/// Those of them with eyes and lids of their own, and the members of the sample head's family that have such.
std::vector<Head> heads_with_lids();

/// A head with weights, that takes poses.
class PosedFace {
 public:
  PosedFace(const Head& head, WeightMethod method);

  [[nodiscard]] const Head& head() const { return head_; }
  [[nodiscard]] const Rig& rig() const { return rig_; }
  [[nodiscard]] PartRole role_of(std::uint32_t file_vertex) const;
  /// #V in the MPEG-4 frame.
  [[nodiscard]] std::vector<glm::vec3> pose(const semblante_frame& frame) const;

 private:
  const Head& head_;
  Rig rig_;
  KernelRig kernel_rig_;
};

/// Of viseme 0 to 14 and expression 0 to 6 at full strength; 0 of either is the face at rest.
semblante_frame frame_of(std::uint8_t viseme, std::uint8_t expression);
/// The head turned by 0.6 rad about each axis, both ways, and by 0.3 about two at once.
std::vector<semblante_frame> head_turns();
/// The triangles that turn with the head in part.
std::vector<Triangle> neck_triangles(const PosedFace& face);
/// Low-level FAPs alone.
semblante_frame frame_of(std::initializer_list<std::pair<int, float>> faps);

}  // namespace semblante::bench

#pragma once

#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/bridges/arkit.h"
#include "tests/support/posed_face.h"

namespace semblante::bench {

/// One of ICT-FaceKit's own shapes, and the coefficients that mean it.
struct IctShape {
  std::string name;
  ArkitCoefficients coefficients{};
  std::vector<glm::vec3> displacement;  ///< #V, as its makers made it
};

/// ICT-FaceKit's head, smooth weights, and its shapes.
struct IctStudy {
  IctStudy(const std::filesystem::path& folder);

  Head head;
  PosedFace face;
  std::vector<IctShape> shapes;
  std::vector<std::uint32_t> skin;    ///< the skin one sees: face, head and neck
  std::vector<std::uint32_t> points;  ///< vertices of the FPs on it

  /// #V: how far a frame moves each vertex.
  [[nodiscard]] std::vector<glm::vec3> displacement_of(const semblante_frame& frame) const;
};

struct BridgeQuality {
  double error = 0.0;        ///< RMS of what is wrong / RMS of the shape, over the skin: 1 is what doing nothing gives
  double cosine = 0.0;       ///< of the two displacement fields
  double point_error = 0.0;  ///< as `error`, at the FPs
};

BridgeQuality compare(const IctStudy& study, const std::vector<glm::vec3>& ours, const std::vector<glm::vec3>& theirs);

/// The FAPs within their ranges that come nearest to a shape on this head, least squares over the skin: what the best
/// possible bridge would do for this one shape. `pull` draws towards `start`, as share of the stiffness.
semblante_frame nearest_faps(const IctStudy& study, const IctShape& shape, const semblante_frame& start, double pull);

}  // namespace semblante::bench

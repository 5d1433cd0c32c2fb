#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/expressions/kernel_rig.h"
#include "core/parametrize/weight_method.h"
#include "core/pipeline/imported.h"
#include "core/types/result.h"
#include "core/types/rig.h"

namespace semblante::pictures {

/// A parametrized model that takes poses in this process: what a client should see, without the package between.
struct PosedHead {
  Model model;
  Rig rig;
  KernelRig kernel_rig;
  std::vector<std::string> warnings;  ///< of all stages, in their order

  /// #V by 3 in the MPEG-4 frame.
  [[nodiscard]] std::vector<glm::vec3> pose(const semblante_frame& frame) const;
  /// PartRole of each file vertex.
  [[nodiscard]] std::vector<PartRole> roles() const;
};

/// Reads and imports a model file.
Result<ImportedHead> load_model(const std::filesystem::path& path);

/// Takes a model file and its feature points through core/pipeline. `max_vertices`: makes it the level of detail of
/// that many vertices, 0: as it is; a warning says when no such level can be made. Errors name the file.
Result<PosedHead> load_posed_head(const std::filesystem::path& model, const std::filesystem::path& feature_points,
                                  WeightMethod weights = WeightMethod::paper, std::uint32_t max_vertices = 0);

/// The methods by the names that --weights takes.
std::map<std::string, WeightMethod> weight_methods();

/// "3=200,19=512" -> a frame. Errors: invalid_argument, naming the entry.
Result<semblante_frame> parse_faps(const std::string& text);

}  // namespace semblante::pictures

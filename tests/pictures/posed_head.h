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

/// A parametrized model that is posed in this process. Shows what a client should show, without the losses of a
/// package.
struct PosedHead {
  Model model;
  Rig rig;
  KernelRig kernel_rig;
  std::vector<std::string> warnings;  ///< of all pipeline stages, in their order

  /// #V by 3 in the MPEG-4 frame.
  [[nodiscard]] std::vector<glm::vec3> pose(const semblante_frame& frame) const;
  /// PartRole of each file vertex.
  [[nodiscard]] std::vector<PartRole> roles() const;
};

/// Reads and imports a model file.
Result<ImportedHead> load_model(const std::filesystem::path& path);

/// Processes a model file and its feature points by core/pipeline. `max_vertices`: uses the level of detail with at
/// most that many vertices, 0: the full mesh; a warning reports that no such level is possible. Errors name the file.
Result<PosedHead> load_posed_head(const std::filesystem::path& model, const std::filesystem::path& feature_points,
                                  WeightMethod weights = WeightMethod::paper, std::uint32_t max_vertices = 0);

/// The methods by the names that --weights takes.
std::map<std::string, WeightMethod> weight_methods();
/// "paper, smooth, fitted"
std::string weight_method_list();

/// Parses "3=200,19=512" to a frame. Errors: invalid_argument, with the entry.
Result<semblante_frame> parse_faps(const std::string& text);

}  // namespace semblante::pictures

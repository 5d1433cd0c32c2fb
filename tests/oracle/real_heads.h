#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/types/marked_point.h"
#include "core/types/model.h"

namespace semblante::oracle {

/// The folder of real heads: $SEMBLANTE_FACES_DIR, or `../shared/faces` beside the source tree; empty where there is
/// none, or one without the folders of the heads. They belong to others and are not part of the project, so tests that
/// want them skip without.
std::optional<std::filesystem::path> faces_folder();

/// `v` and `f` lines of a trusted OBJ, polygons as fans, one primitive per run of `g` or `usemtl`. Positions pass
/// through float32.
Model read_trusted_obj(const std::filesystem::path& file);

/// Any model file, by core/import; throws when it is refused.
Model import_head(const std::filesystem::path& file);

/// Takes the positions of a trusted file of `v` lines, as many as the model has vertices: another person, or the same
/// one in another pose, in the model's vertex order.
void replace_positions(Model& model, const std::filesystem::path& file);

/// The points of a trusted *.fps.json.
std::vector<MarkedPoint> read_trusted_points(const std::filesystem::path& file);

}  // namespace semblante::oracle

#include "protocol/package/pack_head.h"

#include <utility>

namespace semblante {

Result<std::vector<FacePackage>> pack_head(const LevelledHead& head, PackageOptions options, const Progress& progress) {
  if (auto told = report_progress(progress, 0.0, "package"); !told) return told.error();
  options.warnings = head.warnings.all();
  return build_packages(head.model, head.surface, head.rig, head.materials, head.levels, options);
}

}  // namespace semblante

#include "core/pipeline/levelled.h"

#include <utility>

#include "core/anatomy/cavities.h"
#include "core/lod/lod_poses.h"
#include "core/materials/painted_eyes.h"
#include "core/materials/painted_mouth.h"

namespace semblante {

Result<LevelledHead> level_head(RiggedHead rigged, std::vector<std::uint32_t> budgets, const Progress& progress) {
  LevelledHead head{std::move(rigged), {}, {}, {}, {}};
  paint_eyes(head.model, head.surface, head.rig.parts, eyes_of(head.rig));
  const double eye_separation = 1024.0 * head.rig.fapu[FapuUnit::es].value_or(0.0);
  paint_mouth(
      head.model, head.surface, head.rig.parts,
      inside_of_mouth(head.surface, head.rig.parts, surface_points(head.surface, head.rig.points), eye_separation));
  head.materials = assign_materials(head.model, head.surface, head.rig.parts);
  if (budgets.empty()) return head;
  head.poses = lod_poses(head.rig, head.model);
  LodOptions options;
  options.budgets = std::move(budgets);
  options.labels = head.materials.of_triangle;
  options.poses = head.poses;
  if (progress) options.progress = [&progress](double share) { return progress(share, "levels of detail"); };
  auto levels = decimate(head.model, head.surface, head.rig, options);
  if (!levels) return levels.error();
  head.levels = std::move(*levels);
  head.missed = missed_budgets(options.budgets, head.levels);
  for (const MissedBudget& miss : head.missed) head.warnings.levels.push_back(miss.words);
  return head;
}

Result<std::vector<LevelError>> measure_levels(const LevelledHead& head, const Progress& progress) {
  std::vector<LevelError> errors;
  for (const LevelOfDetail& level : head.levels) {
    const double share = static_cast<double>(errors.size()) / static_cast<double>(head.levels.size());
    if (auto told = report_progress(progress, share, "measuring levels"); !told) return told.error();
    errors.push_back(measure_level(head.model, head.surface, level, head.poses));
  }
  return errors;
}

}  // namespace semblante

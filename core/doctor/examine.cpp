#include "core/doctor/examine.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/doctor/mesh_faults.h"
#include "core/doctor/mesh_sides.h"

namespace semblante {
namespace {

void append(Report& report, std::vector<Finding> findings) {
  std::move(findings.begin(), findings.end(), std::back_inserter(report.findings));
}

Report errors_first(Report report) {
  std::stable_sort(report.findings.begin(), report.findings.end(),
                   [](const Finding& a, const Finding& b) { return a.severity < b.severity; });
  return report;
}

}  // namespace

Report examine_mesh(const Model& model, const Surface& surface) {
  Report report;
  const MeshSides mesh = sort_sides(model, surface);
  append(report, find_mesh_faults(model, surface, mesh));
  return errors_first(std::move(report));
}

Report examine(const Model& model, const Surface& surface, const Rig& /*rig*/, WeightMethod /*method*/) {
  return examine_mesh(model, surface);
}

}  // namespace semblante

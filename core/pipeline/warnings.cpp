#include "core/pipeline/warnings.h"

#include "core/types/warning_groups.h"

namespace semblante {

std::vector<std::string> HeadWarnings::all() const {
  std::vector<std::string> list;
  for (const auto* of_stage : {&file, &stance, &points, &rig, &levels})
    list.insert(list.end(), of_stage->begin(), of_stage->end());
  return grouped_warnings(list);
}

}  // namespace semblante

#include "server/jobs/result_facts.h"

#include <algorithm>
#include <string>
#include <utility>

#include <glm/common.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

namespace semblante::jobs {

std::pair<std::array<double, 3>, std::array<double, 3>> box_of(const Model& model) {
  if (model.positions.empty()) return {};
  glm::vec3 low = model.positions.front();
  glm::vec3 high = low;
  for (const auto& position : model.positions) {
    low = glm::min(low, position);
    high = glm::max(high, position);
  }
  return {{low.x, low.y, low.z}, {high.x, high.y, high.z}};
}

std::vector<store::PartRecord> records_of(std::span<const Part> parts) {
  std::vector<store::PartRecord> records;
  for (const auto& part : parts) {
    store::PartRecord record;
    record.name = part.name;
    record.role = std::string(part_role_names[static_cast<std::size_t>(part.role)]);
    record.role_by_user = part.role_by_user;
    record.vertices = part.vertex_count;
    record.triangles = part.triangle_count;
    record.box_min = {part.box_min.x, part.box_min.y, part.box_min.z};
    record.box_max = {part.box_max.x, part.box_max.y, part.box_max.z};
    record.index = static_cast<std::uint32_t>(records.size());
    records.push_back(std::move(record));
  }
  return store::largest_parts(std::move(records), store::max_part_records);
}

store::Turn rows_of(const glm::dmat3& turn) {
  store::Turn rows{};
  const glm::dmat3 by_rows = glm::transpose(turn);
  std::copy_n(glm::value_ptr(by_rows), rows.size(), rows.begin());
  return rows;
}

store::FindingCounts counts_of(const Report& report) {
  const auto counts = report.counts();
  return {static_cast<std::uint32_t>(counts.errors), static_cast<std::uint32_t>(counts.warnings),
          static_cast<std::uint32_t>(counts.notes)};
}

}  // namespace semblante::jobs

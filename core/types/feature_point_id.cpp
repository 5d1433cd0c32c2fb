#include "core/types/feature_point_id.h"

#include "core/types/decimal.h"

namespace semblante {
namespace {

/// Points per group of the standard, groups 2..11. There is no group 1.
constexpr std::array<std::uint8_t, 10> group_sizes = {14, 14, 6, 4, 4, 1, 10, 15, 10, 6};
constexpr int first_group = 2;

struct GroupAndNumber {
  int group;
  int number;
};

constexpr GroupAndNumber split(std::uint8_t index) {
  int group = first_group;
  for (const std::uint8_t size : group_sizes) {
    if (index < size) break;
    index = static_cast<std::uint8_t>(index - size);
    ++group;
  }
  return {group, index + 1};
}

}  // namespace

std::optional<FeaturePointId> parse_feature_point(std::string_view text) {
  int group = 0;
  int number = 0;
  int* part = &group;
  for (const char c : text) {
    if (c == '.' && part == &group) {
      part = &number;
      continue;
    }
    // Only the canonical spelling: "2.01" would be a second key for the same point.
    if (c < '0' || c > '9' || (c == '0' && *part == 0) || *part >= 10) return std::nullopt;
    *part = *part * 10 + (c - '0');
  }
  const int slot = group - first_group;
  if (slot < 0 || slot >= static_cast<int>(group_sizes.size())) return std::nullopt;
  if (number < 1 || number > group_sizes[static_cast<std::size_t>(slot)]) return std::nullopt;
  int index = number - 1;
  for (int g = 0; g < slot; ++g) index += group_sizes[static_cast<std::size_t>(g)];
  return FeaturePointId(static_cast<std::uint8_t>(index));
}

std::string to_string(FeaturePointId id) {
  const auto [group, number] = split(id.value());
  return whole_text(group) + "." + whole_text(number);
}

int group_of(FeaturePointId id) { return split(id.value()).group; }
int number_of(FeaturePointId id) { return split(id.value()).number; }

}  // namespace semblante

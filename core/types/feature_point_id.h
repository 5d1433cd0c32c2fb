#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/types/strong_id.h"

namespace semblante {

/// One of the 84 feature points as a dense index 0..83 in the order of the standard's table: by group, then number.
using FeaturePointId = StrongId<struct FeaturePointTag, std::uint8_t>;

inline constexpr std::size_t feature_point_count = 84;

/// "2.1" -> id; nullopt for anything that is not one of the 84.
std::optional<FeaturePointId> parse_feature_point(std::string_view text);
/// id -> "2.1".
std::string to_string(FeaturePointId id);
int group_of(FeaturePointId id);
int number_of(FeaturePointId id);

}  // namespace semblante

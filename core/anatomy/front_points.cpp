#include "core/anatomy/front_points.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace semblante {

bool is_on_front(FeaturePointId id) {
  static constexpr auto names = std::to_array<std::string_view>(
      {"2.10", "2.11", "2.12", "4.1", "4.2", "4.3",  "4.4", "5.1", "5.2", "5.3",  "5.4",  "8.1",  "8.2",
       "8.5",  "8.6",  "8.7",  "8.8", "8.9", "8.10", "9.3", "9.6", "9.7", "9.12", "9.13", "9.14", "11.1"});
  return std::find(names.begin(), names.end(), to_string(id)) != names.end();
}

}  // namespace semblante

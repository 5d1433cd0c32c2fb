#include "core/import/displacements_file.h"
#include "core/import/feature_points_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto points = semblante::parse_feature_points(text);
  if (points && points->points.empty()) __builtin_trap();
  (void)semblante::parse_displacements(text);
  return 0;
}

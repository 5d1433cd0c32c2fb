#include "server/api/levels.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string>

#include "server/api/common.h"

namespace semblante::api {
namespace {

std::uint32_t number_in(const std::string& text, const std::string& parameter) {
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || error != std::errc() || end != text.data() + text.size())
    refuse("invalid-argument", parameter.substr(1) + " is a whole number", parameter);
  return number;
}

}  // namespace

std::size_t level_of(const http::Request& request, const store::PackageRecord& package) {
  const auto lod = request.query_value("lod");
  const auto most = request.query_value("max_vertices");
  if (lod && most) refuse("invalid-argument", "lod and max_vertices both choose a level: give one", "?max_vertices");
  // A package from before levels existed has one level.
  const std::size_t count = std::max<std::size_t>(package.levels.size(), 1);
  if (lod) {
    const auto level = number_in(std::string(*lod), "?lod");
    if (level >= count)
      refuse("invalid-argument", "the package has the levels 0 to " + std::to_string(count - 1), "?lod");
    return level;
  }
  if (!most) return 0;
  const auto limit = number_in(std::string(*most), "?max_vertices");
  if (limit == 0) refuse("invalid-argument", "max_vertices is 1 or more", "?max_vertices");
  const auto fits = [limit](const store::LevelRecord& level) { return level.vertices <= limit; };
  const auto found = std::find_if(package.levels.begin(), package.levels.end(), fits);
  return found == package.levels.end() ? count - 1 : static_cast<std::size_t>(found - package.levels.begin());
}

}  // namespace semblante::api

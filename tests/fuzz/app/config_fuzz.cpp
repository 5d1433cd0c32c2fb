#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <string>
#include <string_view>

#include "server/app/config_file.h"

// Entries have keys of their own, in the order of their lines; an error names its line.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace semblante;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto lines = static_cast<unsigned>(std::count(text.begin(), text.end(), '\n')) + 1;
  const auto entries = parse_config(text);
  if (!entries) {
    if (entries.error().message.empty() || entries.error().where.empty()) std::abort();
    return 0;
  }
  std::set<std::string> keys;
  unsigned last = 0;
  for (const ConfigEntry& entry : *entries) {
    if (entry.key.empty() || !keys.insert(entry.key).second) std::abort();
    if (!entry.is_array && entry.values.size() != 1) std::abort();
    if (entry.line <= last || entry.line > lines) std::abort();
    last = entry.line;
  }
  return 0;
}

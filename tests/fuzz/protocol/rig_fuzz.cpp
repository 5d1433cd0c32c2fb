#include <cstdlib>

#include "protocol/cpp/rig_document.h"

using namespace semblante;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto rig = read_rig({reinterpret_cast<const char*>(data), size});
  if (!rig) return 0;
  const std::string text = write_rig(*rig);
  const auto echo = read_rig(text);
  if (!echo || write_rig(*echo) != text) std::abort();
  return 0;
}

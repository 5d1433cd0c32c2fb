/* Names that the library has inside, and a use of the C++ library that it has too: neither may meet the library's own.
 */
#include <cstdio>
#include <string>
#include <vector>

#include <semblante/semblante.h>

namespace semblante {
const char* read_rig() { return "mine"; }
struct FrameDecoder {
  FrameDecoder() : words(3, "mine") {}
  std::vector<std::string> words;
};
}  // namespace semblante
extern "C" int semblante_deform_groups_plain(void) { return 7; }

int main() {
  semblante_stream* stream = nullptr;
  if (semblante_stream_create(nullptr, &stream, nullptr) != SEMBLANTE_OK) return 1;
  semblante_stream_destroy(stream);
  std::vector<std::string> words = semblante::FrameDecoder().words;
  words.push_back(semblante::read_rig());
  std::printf("%u %d\n", unsigned(words.size()), semblante_deform_groups_plain());
  return semblante_sdk_version() == SEMBLANTE_SDK_VERSION ? 0 : 1;
}

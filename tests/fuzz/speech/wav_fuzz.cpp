#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/speech/wav.h"

// A sound that is read is written and read again as the same.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace semblante;
  const auto read = read_wav({reinterpret_cast<const char*>(data), size});
  if (!read) {
    if (read.error().message.empty() || read.error().where.empty()) std::abort();
    return 0;
  }
  if (read->samples.empty() || read->samples.size() > size) std::abort();
  Utterance said;
  said.sample_rate = read->sample_rate;
  said.samples = read->samples;
  const auto again = read_wav(wav(said));
  if (!again || again->samples != read->samples || again->sample_rate != read->sample_rate) std::abort();
  return 0;
}

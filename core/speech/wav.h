#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/speech/utterance.h"
#include "core/types/result.h"

namespace semblante {

/// Sound of one channel.
struct Recording {
  std::uint32_t sample_rate = 0;  ///< Hz
  std::vector<std::int16_t> samples;
};

/// Reads a WAV file: PCM of 8, 16, 24 or 32 bits or floats of 32, of one to eight channels, which are mixed. `data` may
/// be longer than the file, as programs write it that do not know its length beforehand. Errors name the byte.
Result<Recording> read_wav(std::string_view file);

/// The sound as a WAV file, 16 bits, one channel.
std::string wav(const Utterance& utterance);

}  // namespace semblante

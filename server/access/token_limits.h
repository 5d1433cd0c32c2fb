#pragma once

#include <cstdint>

namespace semblante::access {

/// What one token may have; 0: no limit. Tokens with the scope admin have none.
struct TokenLimits {
  std::uint64_t bytes = std::uint64_t{8} << 30U;  ///< stored: of models, recordings, speeches and displacement sets
  std::uint64_t models = 250;
  std::uint64_t expressions = 250;
  std::uint64_t streams = 64;
  std::uint64_t recordings = 250;
  std::uint64_t speeches = 250;
  std::uint64_t jobs = 16;    ///< that have not ended
  std::uint64_t uploads = 4;  ///< at the same time
};

}  // namespace semblante::access

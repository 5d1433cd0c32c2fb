#pragma once

#include <optional>
#include <string>

#include "protocol/http/url.h"

namespace semblante::testing {

/// The clock of a stream whose server is on this machine, by the shortest round trip over loopback: without the
/// estimate that it is held against. Times in ms.
struct TrueClock {
  double offset = 0;       ///< the stream's clock minus LiveStream::now()
  double uncertainty = 0;  ///< the offset is off by at most this
};

/// nullopt when the stream cannot be had.
std::optional<TrueClock> measure_true_clock(const client::Url& server, const std::string& stream);

}  // namespace semblante::testing

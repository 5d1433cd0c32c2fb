#pragma once

#include <string>
#include <string_view>

#include "core/types/result.h"

namespace semblante::viewer {

/// A server and one of its streams.
struct StreamAddress {
  std::string server;  ///< "http://HOST[:PORT][/PATH]", or https://
  std::string stream;  ///< empty: the address names none
};

/// Reads ws://HOST/v1/streams/NAME, the address of the page http://HOST/view/NAME, or that of a server alone; wss and
/// https likewise. Errors: invalid_argument (a name that is not percent-encoded correctly).
Result<StreamAddress> parse_stream_address(std::string_view text);

}  // namespace semblante::viewer

#pragma once

namespace semblante::gateways {

/// From here on SIGINT and SIGTERM end no wait of theirs but are remembered.
void catch_stop_signals();
bool stop_requested();

}  // namespace semblante::gateways

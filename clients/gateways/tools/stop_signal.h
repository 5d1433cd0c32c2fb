#pragma once

namespace semblante::gateways {

/// From now on SIGINT and SIGTERM do not end the process but are remembered.
void catch_stop_signals();
bool stop_requested();

}  // namespace semblante::gateways

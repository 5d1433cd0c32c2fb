#pragma once

#include <string_view>

namespace semblante {

/// Tells the service manager (systemd, Type=notify) the state of the service, for example "READY=1": a datagram to the
/// socket that NOTIFY_SOCKET names, as sd_notify(3) describes. Does nothing when the variable is not set; a failure is
/// logged.
void notify_service_manager(std::string_view state);

}  // namespace semblante

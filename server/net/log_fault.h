#pragma once

// Private to net/.

#include <exception>

#include "server/log/guard.h"

namespace semblante::net {

/// For co_spawn: an exception that ends a coroutine ends only its connection.
inline void log_fault(const std::exception_ptr& fault) {
  if (!fault) return;
  log::guarded("a connection ended by a fault", [&] { std::rethrow_exception(fault); });
}

}  // namespace semblante::net

#include "clients/gateways/tools/stop_signal.h"

#include <csignal>

namespace semblante::gateways {
namespace {

volatile std::sig_atomic_t requested = 0;

}  // namespace

void catch_stop_signals() {
  struct sigaction action {};
  action.sa_handler = [](int) { requested = 1; };
  sigemptyset(&action.sa_mask);
  // Without SA_RESTART: waits end immediately. A second signal ends the program the usual way.
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool stop_requested() { return requested != 0; }

}  // namespace semblante::gateways

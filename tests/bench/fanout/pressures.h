#pragma once

#include <string>
#include <vector>

#include "tests/bench/fanout/attacks.h"

namespace semblante::bench {

/// Loads that anyone can put on a server, each until `enough`: readers and writers that are slow, requests with as many
/// headers as are allowed and with more, connections that only wait, handshakes that stop half-way. They run with the
/// lowest priority: what they cost this machine themselves is not the server's doing.
std::vector<Attack> pressures(SemblanteServer& server, const std::string& path, const Options& options);

}  // namespace semblante::bench

#pragma once

#include <string>
#include <vector>

#include "tests/bench/fanout/coding.h"
#include "tests/bench/fanout/publisher.h"

namespace semblante::bench {

struct Options {
  std::size_t subscribers = 0;  ///< 0: as the mode has it
  Feed feed;
  int batch_ms = 0;
  Coding coding = Coding::packed;
  double seconds = 0.0;  ///< of each measurement; 0: as the mode has it
  int repetitions = 0;   ///< 0: as the mode has it
  double stalled = 0.01;
  std::vector<std::string> servers = {"semblante", "semblante-tls", "epoll", "epoll-tls", "beast", "ws"};
  std::string url;      ///< a server that runs already; empty: one of our own
  pid_t pid = 0;        ///< of that
  std::string program;  ///< semblante; empty: the one beside the bench
  std::string only;     ///< which pressures: those with this in their name
  bool tls = false;     ///< a server of our own listens with TLS
  bool apart = false;   ///< a server of our own has the first processor, this program the others
  bool smoke = false;   ///< correctness only: no judgement of any time
};

// Each prints what it measured. 0, or 1 when something broke that must hold.
int compare(const Options& options);
int soak(const Options& options);
int idle(const Options& options);
int stall(const Options& options);
int hostile(const Options& options);
int pressure(const Options& options);

}  // namespace semblante::bench

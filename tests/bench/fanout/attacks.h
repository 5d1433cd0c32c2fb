#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "tests/bench/fanout/options.h"
#include "tests/bench/fanout/target.h"

namespace semblante::bench {

/// What an attack came to: a line for people, and what of the server's promises did not hold.
struct Outcome {
  std::string words;
  std::vector<std::string> broken;
};

/// Something a client does that it should not. Runs on a thread of its own until it has done or `enough` is set.
struct Attack {
  std::string name;
  std::function<Outcome(const std::atomic<bool>& enough)> run;
};

/// All of them, against `path`, a stream that others read, or streams of their own.
std::vector<Attack> attacks(SemblanteServer& server, const std::string& path, const SendTimes& sent,
                            const Options& options);

}  // namespace semblante::bench

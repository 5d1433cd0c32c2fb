// semblante-test-proxy PORT [NAME=VALUE ...]: a network of that kind before a server on loopback. Prints the port it
// listens on, then obeys lines of its standard input (cut, cut BYTES, refuse, accept) until that ends.

#include <cstdlib>
#include <iostream>
#include <map>
#include <sstream>
#include <string>

#include "tests/support/tcp_proxy.h"

int main(int argc, char** argv) {
  semblante::testing::ProxyOptions options;
  double seed = 1;
  const std::map<std::string, double*> names = {{"delay", &options.delay},
                                                {"jitter", &options.jitter},
                                                {"bandwidth", &options.bandwidth},
                                                {"stalls", &options.stalls},
                                                {"stall", &options.stall},
                                                {"cut_every", &options.cut_every},
                                                {"seed", &seed}};
  options.target_port = argc > 1 ? static_cast<std::uint16_t>(std::atoi(argv[1])) : 0;
  bool understood = options.target_port != 0;
  for (int i = 2; i < argc; ++i) {
    const std::string word = argv[i];
    const auto at = word.find('=');
    const auto found = names.find(word.substr(0, at));
    understood = understood && at != std::string::npos && found != names.end();
    if (understood) *found->second = std::atof(word.c_str() + at + 1);
  }
  if (!understood) {
    std::cerr << "usage: semblante-test-proxy PORT [NAME=VALUE ...], NAME one of";
    for (const auto& [name, value] : names) std::cerr << ' ' << name;
    std::cerr << " (ms, bytes/s, shares, s)\n";
    return 2;
  }
  options.seed = static_cast<std::uint64_t>(seed);
  semblante::testing::TcpProxy proxy(options);
  std::cout << proxy.port() << std::endl;
  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream words(line);
    std::string word;
    std::size_t bytes = 0;
    words >> word;
    if (word == "refuse" || word == "accept") {
      proxy.refuse(word == "refuse");
    } else if (word == "cut") {
      if (words >> bytes)
        proxy.cut_after(bytes);
      else
        proxy.cut();
    }
  }
  const auto counts = proxy.counts();
  std::cout << counts.connections << " connections, " << counts.cuts << " cuts, " << counts.bytes_down
            << " bytes down, at most " << counts.worst_lateness << " ms late by itself" << std::endl;
  return 0;
}

#include "server/voice/program.h"

#include <exception>
#include <iostream>

#include "server/voice/voice_protocol.h"

namespace semblante::voice {

void say(std::string_view line) { std::cout.write(line.data(), static_cast<std::streamsize>(line.size())); }

int refuse(const std::string& message, std::string_view member) {
  say(error_line(message, member));
  std::cout.flush();
  return 2;
}

int finish_answer() {
  say(end_line());
  std::cout.flush();
  return std::cout ? 0 : 1;
}

int run_program(int (*run)()) {
  try {
    return run();
  } catch (const std::exception& fault) {
    std::cerr << fault.what() << "\n";
    return 1;
  }
}

}  // namespace semblante::voice

#include "server/app/standard_streams.h"

#include <fcntl.h>
#include <iostream>
#include <unistd.h>

namespace semblante {

void open_standard_streams() {
  // open() takes the lowest free number, and all below are taken.
  for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(number, F_GETFD) < 0) static_cast<void>(::open("/dev/null", O_RDWR));
}

bool is_output_written() { return static_cast<bool>(std::cout.flush()); }

}  // namespace semblante

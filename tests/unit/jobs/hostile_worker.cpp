// A worker that a model took over: it is started, limited and isolated as every worker is, and then does what the first
// argument says.
#include <array>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <string_view>
#include <unistd.h>
#include <vector>

#include <sys/ptrace.h>
#include <sys/socket.h>

#include "server/jobs/worker.h"

namespace semblante::jobs {
namespace {

/// Keeps the compiler from leaving out what has no effect.
volatile char* volatile memory = nullptr;

[[noreturn]] void be_hostile(std::string_view deed) {
  if (deed == "socket") ::socket(AF_INET, SOCK_STREAM, 0);
  if (deed == "fork") ::fork();
  if (deed == "exec") ::execl("/bin/true", "true", nullptr);
  if (deed == "ptrace") ::ptrace(PTRACE_ATTACH, ::getppid(), nullptr, nullptr);
  if (deed == "crash") *memory = 1;
  if (deed == "abort") std::abort();
  if (deed == "hang") {
    while (memory == nullptr) {
    }
  }
  if (deed == "bomb") {
    constexpr std::size_t piece = std::size_t{16} << 20U;
    while (true) {
      memory = new char[piece];
      std::memset(const_cast<char*>(memory), 1, piece);
    }
  }
  _exit(17);  // the deed was possible
}

/// The bytes of a file that is none of the job's, as a message; empty when it cannot be read.
Error foreign_file(const char* path) {
  std::array<char, 64> bytes{};
  const int file = ::open(path, O_RDONLY);
  const auto got = file >= 0 ? ::read(file, bytes.data(), bytes.size()) : 0;
  return {ErrorCode::malformed, "", "it read " + std::to_string(got) + " bytes"};
}

std::uint64_t number_after(std::string_view name, int count, char** arguments) {
  for (int i = 2; i < count; ++i) {
    const std::string_view argument(arguments[i]);
    if (argument.substr(0, name.size()) == name) return std::strtoull(argument.data() + name.size(), nullptr, 10);
  }
  return 0;
}

}  // namespace
}  // namespace semblante::jobs

int main(int count, char** arguments) {
  using namespace semblante::jobs;
  limit_this_process({number_after("--memory=", count, arguments), number_after("--cpu-seconds=", count, arguments),
                      number_after("--file-bytes=", count, arguments)});
  const std::string_view deed(arguments[1]);
  return run_worker([deed](const JobRequest& request, const InputFiles& inputs, ResultFiles& files,
                           const semblante::Progress& progress) -> semblante::Result<JobOutcome> {
    if (deed == "work") return run(request, inputs, files, progress);
    if (deed.substr(0, 1) == "/") return foreign_file(deed.data());
    be_hostile(deed);
  });
}

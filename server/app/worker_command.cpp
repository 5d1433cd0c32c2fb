#include <memory>

#include <CLI/CLI.hpp>
#include <sys/prctl.h>

#include "server/app/commands.h"
#include "server/cli/command_failure.h"
#include "server/jobs/worker.h"

namespace semblante {

void add_worker_command(CLI::App& app) {
  const auto limits = std::make_shared<jobs::WorkerLimits>();
  auto* command = app.add_subcommand(
      "worker",
      "Do one job of a server: its request comes on standard input, progress goes to standard output as JSON "
      "lines. Started by `serve`, not by hand.");
  command->add_option("--memory", limits->memory_bytes, "Address space, bytes; 0: no limit")
      ->envname("SEMBLANTE_JOB_MEMORY")
      ->capture_default_str();
  command->add_option("--cpu-seconds", limits->cpu_seconds, "Processor time, seconds; 0: no limit")
      ->envname("SEMBLANTE_JOB_CPU_SECONDS")
      ->capture_default_str();
  command->add_option("--file-bytes", limits->file_bytes, "Largest file written; 0: no limit")
      ->envname("SEMBLANTE_JOB_FILE_BYTES")
      ->capture_default_str();
  command->callback([limits] {
    ::prctl(PR_SET_NAME, "semblante");  // else "exe", as it was started by /proc/self/exe
    jobs::limit_this_process(*limits);
    if (jobs::run_worker() != 0)
      throw CommandFailure(CommandFailure::bad_input, "worker: the job has a problem (reported on standard output)");
  });
}

}  // namespace semblante

#include <exception>
#include <iostream>
#include <string>
#include <system_error>

#include <CLI/CLI.hpp>

#include "server/app/commands.h"
#include "server/app/installed_files.h"
#include "server/app/standard_streams.h"
#include "server/cli/command_failure.h"
#include "server/cli/commands.h"

namespace semblante {
namespace {

/// What ends a command and is no fault of its input.
std::string words_of(const std::exception& fault) {
  const auto* const system = dynamic_cast<const std::system_error*>(&fault);
  if (system != nullptr && system->code() == std::errc::resource_unavailable_try_again)
    return "the system gives no more threads (" + system->code().message() +
           "): raise the limits of memory (ulimit -v) and of processes (ulimit -u)";
  return std::string("internal error: ") + fault.what();
}

int run_command(int argc, char** argv) {
  CLI::App app("Semblante: a 3D head becomes a face that talks over a thin wire", "semblante");
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("semblante ") + SEMBLANTE_VERSION);
  add_backup_command(app);
  add_check_command(app);
  add_parametrize_command(app);
  add_convert_command(app);
  add_deform_command(app);
  add_doctor_command(app);
  add_examine_command(app);
  add_extract_command(app);
  add_health_command(app);
  add_play_command(app);
  add_propose_command(app);
  add_restore_command(app);
  add_say_command(app, sample_head_file().string());
  add_serve_command(app);
  add_token_command(app);
  add_version_command(app);
  add_worker_command(app);
  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::RequiredError& fault) {
    const bool has_command = !app.get_subcommands().empty();
    std::cerr << "semblante: "
              << (has_command
                      ? fault.what()
                      : "give a subcommand: parametrize, deform, convert, examine, extract, play, propose, say, "
                        "serve, doctor, token, "
                        "check, backup or restore (see semblante --help)")
              << "\n";
    return CommandFailure::bad_input;
  } catch (const CLI::ParseError& fault) {
    std::cerr << "semblante: " << fault.what() << "\n";
    return CommandFailure::bad_input;
  } catch (const CommandFailure& failure) {
    std::cerr << "semblante: " << failure.what() << "\n";
    return failure.exit_code();
  } catch (const std::exception& fault) {
    std::cerr << "semblante: " << words_of(fault) << "\n";
    return CommandFailure::internal;
  }
}

}  // namespace
}  // namespace semblante

// Only a mistake in the options themselves throws outside a try: it may end the program.
int main(int argc, char** argv) {  // NOLINT(bugprone-exception-escape)
  semblante::open_standard_streams();
  const int code = semblante::run_command(argc, argv);
  if (semblante::is_output_written()) return code;
  std::cerr << "semblante: standard output cannot be written\n";
  return code != 0 ? code : semblante::CommandFailure::internal;
}

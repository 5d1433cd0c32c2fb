#pragma once

#include <string>

namespace CLI {
class App;
}

namespace semblante {

// One function per subcommand, each in its own file: declares the options (every option is also an environment variable
// SEMBLANTE_...) and the callback that runs it. A callback that fails throws CommandFailure (command_failure.h); one
// that returns has succeeded.

void add_parametrize_command(CLI::App& app);
void add_convert_command(CLI::App& app);
void add_deform_command(CLI::App& app);
void add_examine_command(CLI::App& app);
void add_extract_command(CLI::App& app);
void add_play_command(CLI::App& app);
void add_propose_command(CLI::App& app);
/// `sample_head`: the file that `--model sample` means; empty: there is none.
void add_say_command(CLI::App& app, const std::string& sample_head);

}  // namespace semblante

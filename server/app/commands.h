#pragma once

namespace CLI {
class App;
}

namespace semblante {

// The subcommands of the service; server/cli/commands.h has those for heads and files.

void add_backup_command(CLI::App& app);
void add_check_command(CLI::App& app);
void add_restore_command(CLI::App& app);
void add_doctor_command(CLI::App& app);
void add_health_command(CLI::App& app);
void add_serve_command(CLI::App& app);
void add_token_command(CLI::App& app);
void add_version_command(CLI::App& app);
void add_worker_command(CLI::App& app);

}  // namespace semblante

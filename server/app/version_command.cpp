#include <iostream>

#include <CLI/CLI.hpp>

#include "server/app/commands.h"

namespace semblante {

void add_version_command(CLI::App& app) {
  app.add_subcommand("version", "Print the version")->callback([] {
    std::cout << "semblante " << SEMBLANTE_VERSION << "\n";
  });
}

}  // namespace semblante

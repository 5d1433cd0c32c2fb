#include <filesystem>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "server/app/commands.h"
#include "server/cli/command_failure.h"
#include "server/upkeep/check.h"

namespace semblante {
namespace {

struct CheckCommand {
  std::filesystem::path data = "data";
  bool json = false, repair = false;
};

void run(const CheckCommand& options) {
  const auto report = options.repair ? upkeep::repair_data(options.data) : upkeep::check_data(options.data);
  if (!report)
    throw CommandFailure(CommandFailure::bad_input, "check: " + options.data.string() + ": " + report.error().message);
  std::cout << (options.json ? upkeep::to_json(*report) : upkeep::to_text(*report)) << std::flush;
  if (const auto faults = report->faults.size(); faults > 0)
    throw CommandFailure(CommandFailure::has_errors, "check: " + options.data.string() + ": it has " +
                                                         std::to_string(faults) + (faults == 1 ? " fault" : " faults"));
}

}  // namespace

void add_check_command(CLI::App& app) {
  const auto options = std::make_shared<CheckCommand>();
  auto* command = app.add_subcommand(
      "check",
      "Compare the files of a data folder with its database and read all of them, also while a server runs; changes "
      "nothing. Exit status 0: no fault; 1: faults; 2: it cannot be checked");
  command->add_option("--data", options->data, "The data folder")->envname("SEMBLANTE_DATA")->capture_default_str();
  command->add_flag("--json", options->json, "Print the report as JSON");
  command->add_flag("--repair", options->repair,
                    "While no server runs: move files that the database does not know to the trash, and files that it "
                    "knows back from there, as a start of the server does; then check");
  command->callback([options] { run(*options); });
}

}  // namespace semblante

#include <filesystem>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>
#include <sys/stat.h>

#include "server/app/commands.h"
#include "server/cli/command_failure.h"
#include "server/http/static_files.h"
#include "server/store/store_error.h"
#include "server/upkeep/backup.h"
#include "server/upkeep/check.h"

namespace semblante {
namespace {

struct BackupCommand {
  std::filesystem::path data = "data", backup;
};

/// Runs one of the two directions; its files are for this account only, as those of the server.
template <class Work>
upkeep::BackupReport run(const std::string& name, const Work& work) {
  ::umask(S_IRWXG | S_IRWXO);
  try {
    auto report = work();
    if (!report) fail(name, report.error());
    std::cout << upkeep::to_text(*report) << std::flush;
    return std::move(*report);
  } catch (const store::StoreError& fault) {
    throw CommandFailure(CommandFailure::internal, name + ": " + fault.what());
  }
}

void run_backup(const BackupCommand& options) {
  // It would be lost with the folder, and in tmp/ it would be removed by the next start.
  if (http::lies_within(options.data, options.backup))
    throw CommandFailure(CommandFailure::bad_input, "backup: " + options.backup.string() +
                                                        " lies within the data folder " + options.data.string() +
                                                        "; choose a place outside of it");
  const auto report = run("backup", [&] { return upkeep::back_up(options.data, options.backup); });
  if (!report.faults.empty())
    throw CommandFailure(CommandFailure::has_errors,
                         "backup: it is complete but for " + std::to_string(report.faults.size()) +
                             " files, which are missing or damaged in " + options.data.string());
}

void run_restore(const BackupCommand& options) {
  run("restore", [&] { return upkeep::restore(options.backup, options.data); });
  const auto check = upkeep::check_data(options.data);
  if (!check) fail("restore", check.error());
  std::cout << upkeep::to_text(*check) << std::flush;
  if (!check->faults.empty())
    throw CommandFailure(CommandFailure::has_errors, "restore: " + options.data.string() + ": it has " +
                                                         std::to_string(check->faults.size()) + " faults");
}

}  // namespace

void add_backup_command(CLI::App& app) {
  const auto options = std::make_shared<BackupCommand>();
  auto* command = app.add_subcommand(
      "backup",
      "Copy a data folder, also while a server runs, as it is at one moment. Exit status 1: some files were "
      "missing or damaged, the others are copied");
  command->add_option("--data", options->data, "The data folder")->envname("SEMBLANTE_DATA")->capture_default_str();
  command->add_option("--to", options->backup, "Folder for the copy; missing or empty")->required();
  command->callback([options] { run_backup(*options); });
}

void add_restore_command(CLI::App& app) {
  const auto options = std::make_shared<BackupCommand>();
  auto* command = app.add_subcommand("restore", "Make a data folder of a backup, and check it");
  command->add_option("--from", options->backup, "The backup, made by `backup`")->required();
  command->add_option("--data", options->data, "The data folder to make; missing or empty")
      ->envname("SEMBLANTE_DATA")
      ->capture_default_str();
  command->callback([options] { run_restore(*options); });
}

}  // namespace semblante

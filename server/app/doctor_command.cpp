#include <algorithm>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <memory>

#include <CLI/CLI.hpp>

#include "server/app/commands.h"
#include "server/app/installation_check.h"
#include "server/app/option_sources.h"
#include "server/app/serve_options.h"
#include "server/cli/command_failure.h"

namespace semblante {
namespace {

void append(InstallationFindings& findings, InstallationFindings more) {
  findings.insert(findings.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

void print(const InstallationFindings& findings) {
  constexpr int level_width = 9;
  constexpr int subject_width = 13;
  for (const auto& finding : findings) {
    const auto* const level = finding.level == InstallationFinding::Level::ok        ? "ok"
                              : finding.level == InstallationFinding::Level::warning ? "warning"
                                                                                     : "error";
    std::cout << std::left << std::setw(level_width) << level << std::setw(subject_width) << finding.subject
              << finding.message << "\n";
    if (!finding.remedy.empty())
      std::cout << std::setw(level_width + subject_width) << ""
                << "-> " << finding.remedy << "\n";
  }
}

}  // namespace

void add_doctor_command(CLI::App& app) {
  const auto options = std::make_shared<ServeOptions>();
  auto* command = app.add_subcommand(
      "doctor",
      "Tell what would keep `serve` with the same options from working on this machine, and what mends it. Exit status "
      "1 if there is an error.");
  declare_serve_options(*command, *options);
  const auto sources = OptionSources::declare(*command, OptionSources::Offers::config);
  command->callback([=] {
    sources->apply();
    auto findings = check_installation(*options);
    append(findings, check_sandbox());
    const auto& listening = options->listening;
    if (!listening.certificate.empty() && !listening.key.empty())
      append(findings, check_certificate(listening.certificate, listening.key));
    print(findings);
    const auto errors = std::count_if(findings.begin(), findings.end(), [](const InstallationFinding& finding) {
      return finding.level == InstallationFinding::Level::error;
    });
    if (errors > 0)
      throw CommandFailure(CommandFailure::has_errors,
                           "doctor: " + std::to_string(errors) + (errors == 1 ? " error" : " errors"));
  });
}

}  // namespace semblante

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "server/app/serve.h"

namespace semblante {

/// One fact about an installation. `remedy`: what mends it; empty when nothing has to be done.
struct InstallationFinding {
  enum class Level { ok, warning, error } level = Level::ok;
  std::string subject;  ///< one or two words
  std::string message;
  std::string remedy;
};
using InstallationFindings = std::vector<InstallationFinding>;

/// Whether a server with these options would work here: the data folder, the address, the studio, the sample head, the
/// worker process, limits and clock of this machine. Changes nothing (a file in the data folder is made and removed).
InstallationFindings check_installation(const ServeOptions& options);

/// What this kernel offers for shutting workers in: seccomp, Landlock, user namespaces.
InstallationFindings check_sandbox();

/// PEM files of TLS, as the server would read them: readable, belonging together, valid now and for 14 days.
InstallationFindings check_certificate(const std::filesystem::path& certificate, const std::filesystem::path& key);

}  // namespace semblante

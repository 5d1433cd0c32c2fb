#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <ostream>
#include <string>

namespace CLI {
class App;
}

namespace semblante {

/// Where the options of a subcommand get their values: the command line before the environment before the
/// configuration file (`--config`) before the default.
class OptionSources {
 public:
  /// Declares `--config` and, if `prints`, `--print-config`. To be called after the other options are declared.
  static std::shared_ptr<OptionSources> declare(CLI::App& command, bool prints);

  /// Reads the configuration file and sets the options that neither the command line nor the environment gave. To be
  /// called first in the subcommand's callback. Throws CommandFailure with file and line: a file that cannot be read,
  /// an unknown key, a value that the option refuses.
  void apply_file();

  [[nodiscard]] bool should_print() const { return print_; }
  /// The options with their values and sources, as a configuration file.
  void print(std::ostream& out) const;

 private:
  explicit OptionSources(CLI::App& command) : command_(command) {}

  CLI::App& command_;
  std::filesystem::path file_;
  bool print_ = false;
  std::map<std::string, unsigned> lines_;  ///< of the options that the file has set
};

}  // namespace semblante

#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <ostream>
#include <string>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace semblante {

/// Where the options of a subcommand get their values: the command line before the environment before the
/// configuration file (`--config`) before the default.
class OptionSources {
 public:
  /// What the subcommand has beside the environment.
  enum class Offers { environment, config, config_and_printing };

  /// Declares `--config` and `--print-config`, if offered, and takes the environment variables of all options over
  /// from CLI11, which does not tell what came from them. To be called after the other options are declared.
  static std::shared_ptr<OptionSources> declare(CLI::App& command, Offers offers);

  /// Sets the options that the command line did not give from the environment and the configuration file. To be called
  /// first in the subcommand's callback. Throws CommandFailure with the variable, or file and line: a file that cannot
  /// be read, an unknown key, a value that the option refuses.
  void apply();

  [[nodiscard]] bool should_print() const { return print_; }
  /// The options with their values and sources, as a configuration file.
  void print(std::ostream& out) const;

 private:
  explicit OptionSources(CLI::App& command) : command_(command) {}
  void apply_environment();
  void apply_file();

  CLI::App& command_;
  std::filesystem::path file_;
  bool print_ = false;
  std::map<const CLI::Option*, std::string> variables_;
  std::map<const CLI::Option*, std::string> sources_;  ///< by option: the source of a value from the file or
                                                       ///< the environment; other options are not in it
};

}  // namespace semblante

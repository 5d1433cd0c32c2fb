#include "server/app/option_sources.h"

#include <algorithm>
#include <cstdlib>

#include <CLI/CLI.hpp>

#include "server/app/config_file.h"
#include "server/cli/command_failure.h"
#include "server/cli/files.h"

namespace semblante {
namespace {

constexpr std::size_t max_file_bytes = std::size_t{1024} * 1024;

/// Help as CLI11 writes it, with the variables that were taken from it.
class HelpWithVariables : public CLI::Formatter {
 public:
  explicit HelpWithVariables(const std::map<const CLI::Option*, std::string>& variables) : variables_(variables) {}

  std::string make_option_opts(const CLI::Option* option) const override {
    const auto variable = variables_.find(option);
    return CLI::Formatter::make_option_opts(option) +
           (variable == variables_.end() ? "" : " (Env:" + variable->second + ")");
  }

 private:
  const std::map<const CLI::Option*, std::string> variables_;
};

bool is_setting(const CLI::Option& option) {
  const auto& name = option.get_single_name();
  return !option.get_lnames().empty() && name != "help" && name != "config" && name != "print-config";
}

bool is_flag(const CLI::Option& option) { return option.get_items_expected_max() == 0; }
bool is_list(const CLI::Option& option) { return option.get_items_expected_max() > 1; }

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result.push_back('\\');
    if (c == '\n' || c == '\t')
      result.append(c == '\n' ? "\\n" : "\\t");
    else
      result.push_back(c);
  }
  return result + '"';
}

std::string written(const std::string& value) {
  const bool whole =
      !value.empty() && std::all_of(value.begin(), value.end(), [](char c) { return c >= '0' && c <= '9'; });
  return whole ? value : quoted(value);
}

std::string value_of(const CLI::Option& option) {
  if (is_flag(option)) return option.count() > 0 && option.as<bool>() ? "true" : "false";
  if (!is_list(option)) {
    if (option.count() > 0) return written(option.reduced_results().back());
    const auto text = option.get_default_str();  // of a path: in quotes
    const bool in_quotes = text.size() >= 2 && text.front() == '"' && text.back() == '"';
    return written(in_quotes ? text.substr(1, text.size() - 2) : text);
  }
  std::string list;
  if (option.count() > 0)
    for (const auto& value : option.results()) list.append(list.empty() ? "" : ", ").append(quoted(value));
  return "[" + list + "]";
}

}  // namespace

std::shared_ptr<OptionSources> OptionSources::declare(CLI::App& command, Offers offers) {
  std::shared_ptr<OptionSources> sources(new OptionSources(command));
  if (offers != Offers::environment)
    command
        .add_option("--config", sources->file_,
                    "Configuration file (TOML): any of these options by its name without --, e.g. port = 8080; the "
                    "command line and the environment have precedence")
        ->envname("SEMBLANTE_CONFIG");
  if (offers == Offers::config_and_printing)
    command.add_flag("--print-config", sources->print_,
                     "Print the effective value of each option with its source, as a configuration file, and end");
  for (auto* const option : command.get_options()) {
    const auto variable = option->get_envname();
    if (variable.empty()) continue;
    sources->variables_[option] = variable;
    option->envname("");
  }
  command.formatter(std::make_shared<HelpWithVariables>(sources->variables_));
  return sources;
}

void OptionSources::apply() {
  apply_environment();
  apply_file();
}

void OptionSources::apply_environment() {
  for (auto* const option : command_.get_options()) {
    const auto variable = variables_.find(option);
    const char* value = variable == variables_.end() ? nullptr : std::getenv(variable->second.c_str());
    if (value == nullptr || *value == '\0' || option->count() > 0) continue;
    try {
      option->add_result(value);
      option->run_callback();
    } catch (const CLI::ParseError& fault) {
      throw CommandFailure(CommandFailure::bad_input,
                           command_.get_name() + ": " + variable->second + ": " + fault.what());
    }
    sources_[option] = "environment " + variable->second;
  }
}

void OptionSources::apply_file() {
  if (file_.empty()) return;
  const auto who = command_.get_name();
  const auto refuse = [&](const std::string& line, const std::string& message) {
    throw CommandFailure(CommandFailure::bad_input, who + ": " + file_.string() + ":" + line + ": " + message);
  };
  const auto bytes = read_file(file_.string(), max_file_bytes);
  const auto entries = parse_config(std::string(bytes.begin(), bytes.end()));
  if (!entries) refuse(entries.error().where, entries.error().message);
  for (const auto& entry : *entries) {
    auto* option = command_.get_option_no_throw("--" + entry.key);
    const auto line = std::to_string(entry.line);
    if (option == nullptr || !is_setting(*option))
      refuse(line,
             "unknown key " + entry.key + " (the keys are the options of semblante " + who + " --help, without --)");
    if (entry.is_array && !is_list(*option)) refuse(line, entry.key + " takes one value, not an array");
    if (is_flag(*option) && entry.values != CLI::results_t{"true"} && entry.values != CLI::results_t{"false"})
      refuse(line, entry.key + " is true or false");
    if (option->count() > 0) continue;
    if (entry.values.empty()) continue;  // an empty array
    try {
      option->add_result(entry.values);
      option->run_callback();
    } catch (const CLI::ParseError& fault) {
      refuse(line, fault.what());
    }
    sources_[option] = file_.string() + ":" + line;
  }
}

void OptionSources::print(std::ostream& out) const {
  for (const CLI::Option* option : command_.get_options([](const CLI::Option* each) { return is_setting(*each); })) {
    const auto found = sources_.find(option);
    const auto source = found != sources_.end() ? found->second : option->count() > 0 ? "option" : "default";
    out << option->get_single_name() << " = " << value_of(*option) << "  # " << source << "\n";
  }
}

}  // namespace semblante

#include <ctime>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>

#include <CLI/CLI.hpp>
#include <sys/stat.h>

#include "server/access/new_token.h"
#include "server/app/commands.h"
#include "server/cli/command_failure.h"
#include "server/store/data_files.h"
#include "server/store/sqlite_store.h"

namespace semblante {
namespace {

struct TokenOptions {
  std::filesystem::path data = "data";
  std::string name, scope, stream, model, id;
  std::uint64_t life = 0;  ///< seconds; 0: does not expire
};

/// The first token may be made before the first start of the server, in a folder that is empty yet.
enum class Folder { used, used_or_empty };

[[noreturn]] void refuse_options(const std::string& message) {
  throw CommandFailure(CommandFailure::bad_input, "token: " + message);
}

/// A mistyped folder would get a database of its own, with tokens that no server knows.
void expect_data_folder(const std::filesystem::path& data, Folder folder) {
  std::error_code error;
  if (std::filesystem::exists(data / store::database_file_name, error)) return;
  const auto status = std::filesystem::status(data, error);
  if (status.type() == std::filesystem::file_type::not_found)
    refuse_options("--data: there is no folder " + data.string() + "; the first start of the server makes it");
  if (status.type() != std::filesystem::file_type::directory)
    refuse_options("--data: " + data.string() + (error ? ": " + error.message() : " is no folder"));
  const bool is_empty = std::filesystem::is_empty(data, error);
  if (error) refuse_options("--data: " + data.string() + ": " + error.message());
  if (folder == Folder::used || !is_empty)
    refuse_options("--data: there is no " + std::string(store::database_file_name) + " in " + data.string() +
                   "; the first start of the server makes it");
}

std::unique_ptr<store::Store> open(const TokenOptions& options, Folder folder) {
  ::umask(S_IRWXG | S_IRWXO);
  expect_data_folder(options.data, folder);
  auto store = store::open_sqlite_store(options.data / store::database_file_name);
  if (!store) fail("token: --data", store.error());
  return std::move(*store);
}

void create(const TokenOptions& options) {
  const auto scope = access::parse_scope(options.scope);
  if (!scope) refuse_options("--scope: " + options.scope + " is not one of " + access::token_scopes_in_words());
  if (!options.stream.empty() && !options.model.empty())
    refuse_options("--stream and --model cannot be given together");
  if (*scope == access::Scope::admin && !(options.stream.empty() && options.model.empty()))
    refuse_options("--scope: admin is not limited to a stream or a model");
  access::TokenWish wish{options.name, *scope, options.stream, options.model, {}};
  if (options.life > 0) wish.life = static_cast<std::int64_t>(options.life);
  const auto made = access::make_token(wish);
  open(options, Folder::used_or_empty)->add_token(made.record);
  std::cout << made.text << "\n";
  std::cerr << "This is the only time that the token is shown; its id is " << made.record.id << ".\n";
}

std::string limit_of(const store::TokenRecord& token) {
  if (!token.stream.empty()) return "stream " + token.stream;
  if (!token.model.empty()) return "model " + token.model;
  return "all";
}

std::string end_of(const store::TokenRecord& token) {
  if (!token.expires) return "never expires";
  const bool expired = *token.expires <= static_cast<std::int64_t>(std::time(nullptr));
  return (expired ? "expired " : "expires ") + store::timestamp_of(*token.expires);
}

void list(const TokenOptions& options) {
  for (const auto& token : open(options, Folder::used)->tokens())
    std::cout << token.id << "\t" << token.scope << "\t" << limit_of(token) << "\t" << end_of(token) << "\t"
              << token.name << "\n";
}

void revoke(const TokenOptions& options) {
  if (!open(options, Folder::used)->remove_token(options.id)) refuse_options("there is no token " + options.id);
}

}  // namespace

void add_token_command(CLI::App& app) {
  const auto options = std::make_shared<TokenOptions>();
  auto* command = app.add_subcommand(
      "token", "Create, list and revoke the tokens of a data folder; a running server knows it within a second");
  command->require_subcommand(1);
  const auto add_data = [&](CLI::App* sub) {
    sub->add_option("--data", options->data, "The server's data folder")
        ->envname("SEMBLANTE_DATA")
        ->capture_default_str();
  };
  const std::map<std::string, std::uint64_t> time_units = {{"s", 1}, {"min", 60}, {"h", 3600}, {"d", 86400}};
  constexpr std::uint64_t longest = std::uint64_t{10} * 365 * 86400;

  auto* creating = command->add_subcommand("create", "Make a token, and print its text to standard output, once");
  add_data(creating);
  creating->add_option("--scope", options->scope, access::token_scopes_in_words() + "; each includes those before it")
      ->required();
  creating->add_option("--name", options->name, "A name for people");
  creating->add_option("--stream", options->stream, "Only this stream, and reading the model that it shows");
  creating->add_option("--model", options->model, "Only this model, with its jobs");
  creating->add_option("--expires", options->life, "How long it is accepted, seconds (or 12h, 30d); left out: forever")
      ->transform(CLI::AsNumberWithUnit(time_units, CLI::AsNumberWithUnit::DEFAULT, "TIME"))
      ->check(CLI::Range(std::uint64_t{1}, longest));
  creating->callback([options] { create(*options); });

  auto* listing = command->add_subcommand("list", "One line for each token: id, scope, limit, end, name");
  add_data(listing);
  listing->callback([options] { list(*options); });

  auto* revoking = command->add_subcommand("revoke", "End a token, and the streams that were opened with it");
  add_data(revoking);
  revoking->add_option("id", options->id, "Id of the token, as `token list` prints it")->required();
  revoking->callback([options] { revoke(*options); });
}

}  // namespace semblante

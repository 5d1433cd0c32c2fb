#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>

#include "server/app/command_failure.h"
#include "server/app/commands.h"
#include "server/app/files.h"
#include "server/app/head_input.h"
#include "server/app/weights_json.h"
#include "server/package/package.h"

namespace semblante {
namespace {

struct ParametrizeCommand {
  HeadOptions head;
  std::string weights_json;
  std::string out;
  std::string name;
  int weight_bits = 12;
};

/// The package as files: what a client fetches by URL, under the same names.
void write_package(const FacePackage& package, const std::filesystem::path& folder) {
  std::error_code fault;
  std::filesystem::create_directories(folder, fault);
  if (fault) throw CommandFailure(CommandFailure::bad_input, folder.string() + ": " + fault.message());
  write_file((folder / "mesh.drc").string(), package.mesh_drc.bytes);
  write_file((folder / "weights").string(), package.weights.bytes);
  write_file((folder / "rig.json").string(), package.rig_json.bytes);
  write_file((folder / "face.glb").string(), package.face_glb.bytes);
  if (package.images.empty()) return;
  std::filesystem::create_directories(folder / "artefacts", fault);
  for (const Artefact& image : package.images) {
    write_file((folder / "artefacts" / to_hex(image.sha256)).string(), image.bytes);
  }
}

FacePackage encode(const Head& head, const ParametrizeCommand& options) {
  PackageOptions package_options;
  package_options.name =
      options.name.empty() ? std::filesystem::path(options.head.model_path).stem().string() : options.name;
  package_options.weight_bits = options.weight_bits;
  auto package = build_package(head.model, head.surface, head.rig, package_options);
  if (!package) fail(options.head.model_path, package.error());
  return std::move(*package);
}

void run(const ParametrizeCommand& options) {
  if (options.weights_json.empty() && options.out.empty()) {
    throw CommandFailure(CommandFailure::bad_input, "parametrize: give --weights-json, --out or both");
  }
  const Head head = load_head(options.head);
  if (!options.weights_json.empty()) {
    write_file(options.weights_json, [&head](std::ostream& out) { write_weights_json(head.rig, out); });
  }
  if (!options.out.empty()) write_package(encode(head, options), options.out);
  print_warnings(head.warnings, options.head.quiet);
}

}  // namespace

void add_parametrize_command(CLI::App& app) {
  auto options = std::make_shared<ParametrizeCommand>();
  CLI::App* const command =
      app.add_subcommand("parametrize", "Compute the weights of a head, once, for all its frames");
  add_head_options(*command, options->head);
  command
      ->add_option("--weights-json", options->weights_json,
                   "Write W of Eq. 4 of every file vertex as JSON; - is standard output")
      ->envname("SEMBLANTE_WEIGHTS_JSON");
  command->add_option("--out", options->out, "Write the face package into this folder")->envname("SEMBLANTE_OUT");
  command->add_option("--name", options->name, "Name of the model in the package; else that of its file")
      ->envname("SEMBLANTE_NAME");
  command->add_option("--weight-bits", options->weight_bits, "Bits of a weight in the package")
      ->check(CLI::Range(8, 16))
      ->capture_default_str()
      ->envname("SEMBLANTE_WEIGHT_BITS");
  command->callback([options] { run(*options); });
}

}  // namespace semblante

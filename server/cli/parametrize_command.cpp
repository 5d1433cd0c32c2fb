#include <charconv>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>

#include <CLI/CLI.hpp>

#include "core/extract/own_sets.h"
#include "core/pipeline/levelled.h"
#include "protocol/package/pack_head.h"
#include "server/cli/command_failure.h"
#include "server/cli/commands.h"
#include "server/cli/files.h"
#include "server/cli/head_input.h"
#include "server/cli/progress_line.h"
#include "server/cli/weights_json.h"

namespace semblante {
namespace {

struct ParametrizeCommand {
  HeadOptions head;
  std::string weights_json;
  std::string out;
  std::string name;
  int weight_bits = 12;
  std::vector<std::string> lods;
  std::string expressions = "library";
};

/// Writes one level's package as files, with the same names as in the URLs for clients.
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

/// Parses "10000,5000", "auto" or an empty text.
std::vector<std::uint32_t> budgets_of(const ParametrizeCommand& options, const Model& model) {
  if (options.lods == std::vector<std::string>{"auto"}) {
    return default_budgets(static_cast<std::uint32_t>(model.positions.size()));
  }
  std::vector<std::uint32_t> budgets;
  for (const std::string& text : options.lods) {
    std::uint32_t budget = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), budget);
    if (fault != std::errc{} || end != text.data() + text.size() || budget < least_budget || budget > most_budget ||
        (!budgets.empty() && budget >= budgets.back()) || budgets.size() == max_levels) {
      throw CommandFailure(CommandFailure::bad_input,
                           "--lods: '" + text + "' does not fit: at most " + std::to_string(max_levels) +
                               " falling numbers of vertices, " + std::to_string(least_budget) + " or more, or auto");
    }
    budgets.push_back(budget);
  }
  return budgets;
}

/// The head's own visemes and expressions, if they are asked for; what was found becomes remarks of the command.
std::vector<NamedSet> worn_by(const Head& head, const ParametrizeCommand& options, std::vector<std::string>& remarks) {
  if (options.expressions != "own") return {};
  auto own = own_sets(head.model, head.points, head.rig.fapu);
  if (!own) fail("--expressions own", own.error());
  remarks.insert(remarks.end(), own->words.begin(), own->words.end());
  return std::move(own->sets);
}

/// "fitted to 19 shapes: ..." on stderr.
void print_fit(const WeightFit& fit) {
  std::cerr << std::fixed << std::setprecision(3) << "semblante: fitted to " << fit.shapes.size()
            << " shapes of the head; mean error of a shape predicted by a fit to the others " << fit.error()
            << " (smooth weights " << fit.smooth_error() << ", no motion 1)\n";
  if (!fit.ignored.empty())
    std::cerr << "semblante: not fitted to " << fit.ignored.size() << " shapes that move no feature point, or all\n";
}

/// "articulation 2.24: in its own a (viseme_aa), ..." on stderr.
void print_articulation(const Head& head) {
  std::cerr << std::defaultfloat << std::setprecision(3) << "semblante: articulation " << head.rig.articulation << ": "
            << head.articulation_reason << "\n";
}

std::vector<FacePackage> pack(const LevelledHead& head, const ParametrizeCommand& options, std::vector<NamedSet> worn,
                              const Progress& progress) {
  PackageOptions package_options;
  package_options.worn = std::move(worn);
  package_options.name =
      options.name.empty() ? std::filesystem::path(options.head.model_path).stem().string() : options.name;
  package_options.weight_bits = options.weight_bits;
  auto packages = pack_head(head, std::move(package_options), progress);
  if (!packages) fail(options.head.model_path, packages.error());
  return std::move(*packages);
}

void write_packages(Head& head, const ParametrizeCommand& options) {
  const ProgressLine line(options.head.quiet);
  const Progress progress = line.progress();
  auto budgets = budgets_of(options, head.model);
  auto worn = worn_by(head, options, head.remarks);
  // What the stages made is moved; the command's remarks stay.
  auto levelled =
      level_head(std::move(static_cast<RiggedHead&>(head)), std::move(budgets), part_of(progress, 0.0, 0.5));
  if (!levelled) fail(options.head.model_path, levelled.error());
  const std::filesystem::path folder(options.out);
  const auto packages = pack(*levelled, options, std::move(worn), part_of(progress, 0.5, 1.0));
  for (std::size_t lod = 0; lod < packages.size(); ++lod) {
    write_package(packages[lod], lod == 0 ? folder : folder / ("lod" + std::to_string(lod)));
  }
  head.warnings = std::move(levelled->warnings);
}

void run(const ParametrizeCommand& options) {
  if (options.weights_json.empty() && options.out.empty()) {
    throw CommandFailure(CommandFailure::bad_input, "parametrize: give --weights-json, --out or both");
  }
  Head head = load_head(options.head);
  if (!options.weights_json.empty()) {
    write_file(options.weights_json,
               [&](std::ostream& out) { write_weights_json(head.rig, rig_request(options.head), out); });
  }
  const std::optional<WeightFit> fit = head.rig.fit;
  if (head.rig.articulation != usual_articulation && !options.head.articulation && !options.head.quiet)
    print_articulation(head);
  if (!options.out.empty()) write_packages(head, options);
  if (fit && !options.head.quiet) print_fit(*fit);
  print_warnings(head.all_warnings(), options.head.quiet);
}

}  // namespace

void add_parametrize_command(CLI::App& app) {
  auto options = std::make_shared<ParametrizeCommand>();
  CLI::App* const command =
      app.add_subcommand("parametrize", "Compute the weights of a head, once, for all its frames");
  add_head_options(*command, options->head, PointsOption::found);
  command
      ->add_option("--weights-json", options->weights_json,
                   "Write the weights of every file vertex as JSON, with their method and whether they are W of Eq. 4 "
                   "or shares; "
                   "- is standard output")
      ->envname("SEMBLANTE_WEIGHTS_JSON");
  command->add_option("--out", options->out, "Write the face package into this folder")->envname("SEMBLANTE_OUT");
  command->add_option("--name", options->name, "Name of the model in the package; else that of its file")
      ->envname("SEMBLANTE_NAME");
  command
      ->add_option("--expressions", options->expressions,
                   "Visemes and expressions of the package: library, or own, those of the head's own morph targets "
                   "where it has them")
      ->check(CLI::IsMember({"library", "own"}))
      ->capture_default_str()
      ->envname("SEMBLANTE_EXPRESSIONS");
  command->add_option("--weight-bits", options->weight_bits, "Bits of a weight in the package")
      ->check(CLI::Range(8, 16))
      ->capture_default_str()
      ->envname("SEMBLANTE_WEIGHT_BITS");
  command
      ->add_option(
          "--lods", options->lods,
          "Levels of detail, into folders lod1, lod2, ... of --out: numbers of vertices, falling (10000,5000), or auto")
      ->delimiter(',')
      ->envname("SEMBLANTE_LODS");
  command->callback([options] { run(*options); });
}

}  // namespace semblante

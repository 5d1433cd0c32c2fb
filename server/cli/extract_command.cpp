#include <filesystem>
#include <iomanip>
#include <memory>
#include <ostream>
#include <sstream>
#include <utility>

#include <CLI/CLI.hpp>

#include "core/extract/extract.h"
#include "core/extract/set_file.h"
#include "core/extract/shape.h"
#include "core/import/limits.h"
#include "core/parametrize/fapu.h"
#include "server/cli/command_failure.h"
#include "server/cli/commands.h"
#include "server/cli/files.h"
#include "server/cli/head_input.h"
#include "server/cli/real_range.h"

namespace semblante {
namespace {

struct ExtractCommand {
  HeadOptions head;
  std::string expression;    ///< a file of the same mesh, or empty
  std::string target, from;  ///< morph targets of the head's own file
  std::string name, kind = "expression";
  ExtractOptions options;
  std::string out = "-";
};

/// The file is already named, so only a line or a vertex in it is added.
Error without_field(Error error) {
  if (error.where == "/expression") error.where.clear();
  return error;
}

/// The two shapes, in the MPEG-4 frame.
struct Shapes {
  std::vector<glm::vec3> neutral, expression;
};

std::vector<glm::vec3> shape_of(const std::string& option, const std::string& path, const Model& model,
                                const std::string& target) {
  auto shape = shape_of_target(model, target);
  if (!shape) fail(path, {shape.error().code, option + " " + target, shape.error().message});
  return std::move(*shape);
}

/// The positions of the expression file, unturned; `neutral` is the head, unturned too.
std::vector<glm::vec3> read_expression(const std::string& path, const Model& neutral) {
  const auto bytes = read_file(path, ImportLimits{}.max_file_bytes);
  auto expression = shape_of_file(neutral, bytes, std::filesystem::path(path).filename().string());
  if (!expression) fail(path, without_field(expression.error()));
  return std::move(*expression);
}

Shapes shapes_of_targets(const ExtractCommand& options, const MarkedHead& head) {
  return {shape_of("--from", options.head.model_path, head.model, options.from),
          shape_of("--target", options.head.model_path, head.model, options.target)};
}

std::string default_name(const ExtractCommand& options) {
  return options.target.empty() ? std::filesystem::path(options.expression).stem().string() : options.target;
}

void run(const ExtractCommand& options) {
  if (options.expression.empty() == options.target.empty()) {
    throw CommandFailure(CommandFailure::bad_input,
                         "extract: give the file of the expression, or --target with a morph target of the head");
  }
  HeadFiles files = read_head(options.head);
  std::vector<glm::vec3> expression;
  if (options.target.empty()) expression = read_expression(options.expression, files.head.model);
  const MarkedHead head = place_points(std::move(files), options.head);
  // Turned like the head, with its points' vertices.
  for (glm::vec3& p : expression) p = glm::vec3(head.to_mpeg4 * glm::dvec3(p));
  if (options.target.empty()) add_inserted(expression, head.inserted);
  const Shapes shapes =
      options.target.empty() ? Shapes{head.model.positions, std::move(expression)} : shapes_of_targets(options, head);
  std::vector<std::string> warnings = head.warnings.all();
  const Fapu fapu = compute_fapu(head.points, head.fapu_by_user);
  const auto extraction = extract_displacements(head.points, fapu, shapes.neutral, shapes.expression, options.options);
  if (!extraction) {
    fail(options.expression.empty() ? options.head.model_path : options.expression, without_field(extraction.error()));
  }
  const NamedSet set{options.name.empty() ? default_name(options) : options.name, *parse_set_kind(options.kind),
                     extraction->displacements};
  const std::string json = write_displacement_set(set);
  // Checks that the result can be read: a name from the command line may be invalid.
  if (const auto back = parse_displacement_set(json); !back) fail("--name", back.error());
  write_file(options.out, [&json](std::ostream& out) { out << json; });
  for (std::string& sentence : explain(*extraction)) warnings.push_back(std::move(sentence));
  if (extraction->removed) {
    std::ostringstream words;
    words << "the head turned by " << std::setprecision(3) << extraction->removed->degrees << " degrees and moved by "
          << extraction->removed->distance << " between the two; that was taken out";
    warnings.push_back(words.str());
  }
  print_warnings(warnings, options.head.quiet);
}

}  // namespace

void add_extract_command(CLI::App& app) {
  auto options = std::make_shared<ExtractCommand>();
  CLI::App* const command = app.add_subcommand(
      "extract", "Take a displacement set, for any head, from a neutral and an expression shape of one mesh");
  add_file_options(*command, options->head);
  CLI::Option* const expression =
      command
          ->add_option("EXPRESSION", options->expression,
                       "The same mesh in the expression: a file with the same vertices in the same order; faces may be "
                       "missing")
          ->envname("SEMBLANTE_EXPRESSION_FILE");
  CLI::Option* const target =
      command->add_option("--target", options->target, "A morph target of MODEL, instead of EXPRESSION")
          ->excludes(expression)
          ->envname("SEMBLANTE_TARGET");
  command->add_option("--from", options->from, "The morph target to start from, instead of the neutral shape")
      ->needs(target)
      ->envname("SEMBLANTE_FROM");
  command->add_option("--name", options->name, "Of the set; otherwise that of the file or the target")
      ->envname("SEMBLANTE_NAME");
  command->add_option("--kind", options->kind, "What the set is for: expression (FAP 2) or viseme (FAP 1)")
      ->check(CLI::IsMember({"expression", "viseme"}))
      ->capture_default_str()
      ->envname("SEMBLANTE_KIND");
  command->add_flag("--align", options->options.align, "Take the motion of the whole head between the two out first")
      ->envname("SEMBLANTE_ALIGN");
  command
      ->add_option("--least", options->options.least,
                   "Points that move by less than this many FAPU units are not in the set; 0 keeps all")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str()
      ->envname("SEMBLANTE_LEAST");
  command
      ->add_option("--strength", options->options.strength,
                   "How much of the expression the example shows: 0.5 doubles what it moves")
      ->check(real_range(least_strength, most_strength))
      ->capture_default_str()
      ->envname("SEMBLANTE_STRENGTH");
  command->add_option("-o,--out", options->out, "JSON file to write; - is standard output")
      ->capture_default_str()
      ->envname("SEMBLANTE_OUT");
  command->callback([options] { run(*options); });
}

}  // namespace semblante

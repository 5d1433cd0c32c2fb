#include <memory>

#include <CLI/CLI.hpp>

#include "core/expressions/kernel_rig.h"
#include "server/cli/command_failure.h"
#include "server/cli/commands.h"
#include "server/cli/deform_sequence.h"
#include "server/cli/face_options.h"
#include "server/cli/face_reading_options.h"
#include "server/cli/files.h"
#include "server/cli/head_input.h"
#include "server/cli/obj_writer.h"
#include "server/cli/real_range.h"

namespace semblante {
namespace {

struct DeformCommand {
  HeadOptions head;
  FaceOptions face;
  DeformSequence sequence;
  std::string out;
};

void run(const DeformCommand& options) {
  const FaceOptions& face = options.face;
  if (!options.sequence.frames.empty()) {
    Head head = load_head(options.head);
    write_deformed_sequence(options.sequence, head, options.out);
    print_warnings(head.all_warnings(), options.head.quiet);
    return;
  }
  if (face.faps.empty() && face.viseme.empty() && face.expression.empty() && face.displacements.empty() &&
      face.set.empty()) {
    throw CommandFailure(
        CommandFailure::bad_input,
        "deform: give --faps, --viseme, --expression, --set (or several of them), --displacements or --frames");
  }
  Head head = load_head(options.head);
  const semblante_pose pose = make_pose(face, head, head.remarks);

  static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
  std::vector<glm::vec3> deformed(head.model.positions.size());
  const semblante_face rows = make_kernel_face(head.rig, &head.model.positions.front().x);
  semblante_deform(&rows, &pose, &deformed.front().x);
  write_file(options.out, [&](std::ostream& out) { write_obj(head.model, deformed, out); });
  print_warnings(head.all_warnings(), options.head.quiet);
}

}  // namespace

void add_deform_command(CLI::App& app) {
  auto options = std::make_shared<DeformCommand>();
  CLI::App* const command =
      app.add_subcommand("deform", "Write a head in one face as OBJ, or in the faces of a file as a mesh each");
  add_head_options(*command, options->head, PointsOption::found);
  FaceOptions& face = options->face;
  CLI::Option* const faps = command->add_option("--faps", face.faps, "Low-level FAPs in FAP units: \"3=200,19=512\"")
                                ->envname("SEMBLANTE_FAPS");
  CLI::Option* const viseme = command->add_option("--viseme", face.viseme, "Viseme of FAP 1: number 0..14 or name")
                                  ->envname("SEMBLANTE_VISEME");
  CLI::Option* const expression =
      command->add_option("--expression", face.expression, "Expression of FAP 2: number 1..6 or name")
          ->envname("SEMBLANTE_EXPRESSION");
  CLI::Option* const set =
      command->add_option("--set", face.set, "JSON file of a displacement set, as `semblante extract` writes it")
          ->envname("SEMBLANTE_SET");
  command->add_option("--intensity,--at", face.intensity, "Of the viseme, the expression and the set, 0..1")
      ->check(real_range(0.0, 1.0))
      ->capture_default_str()
      ->envname("SEMBLANTE_INTENSITY");
  CLI::Option* const displacements =
      command
          ->add_option("--displacements", face.displacements,
                       "JSON file {\"2.1\": [dx, dy, dz], ...}: feature points moved in the model file's axes and unit")
          ->excludes(faps)
          ->excludes(viseme)
          ->excludes(expression)
          ->excludes(set)
          ->envname("SEMBLANTE_DISPLACEMENTS");
  DeformSequence& sequence = options->sequence;
  CLI::Option* const frames = command
                                  ->add_option("--frames", sequence.frames,
                                               "File of faces in time (" + readable_face_formats() +
                                                   "): a numbered mesh of each in the folder --out")
                                  ->excludes(faps)
                                  ->excludes(viseme)
                                  ->excludes(expression)
                                  ->excludes(set)
                                  ->excludes(displacements)
                                  ->envname("SEMBLANTE_FRAMES");
  command->add_option("--frames-format", sequence.frames_format, "Of --frames, if its name does not tell")
      ->needs(frames)
      ->envname("SEMBLANTE_FRAMES_FORMAT");
  add_face_reading_options(*command, sequence.reading);
  command->add_option("--from", sequence.from, "First frame, by its number")->needs(frames)->envname("SEMBLANTE_FROM");
  command->add_option("--to", sequence.to, "Last frame")->needs(frames)->envname("SEMBLANTE_TO");
  command->add_option("--between", sequence.between, "Meshes between each frame and the next, feature points linearly")
      ->needs(frames)
      ->check(CLI::Range(0, 1000))
      ->capture_default_str()
      ->envname("SEMBLANTE_BETWEEN");
  command->add_option("--mesh-format", sequence.format, "Of the meshes of --frames")
      ->needs(frames)
      ->check(CLI::IsMember({"obj", "ply"}))
      ->capture_default_str()
      ->envname("SEMBLANTE_MESH_FORMAT");
  command->add_option("--out", options->out, "OBJ file to write, - is standard output; with --frames a folder")
      ->required()
      ->envname("SEMBLANTE_OUT");
  command->callback([options] { run(*options); });
}

}  // namespace semblante

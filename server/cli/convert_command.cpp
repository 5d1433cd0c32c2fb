#include <filesystem>
#include <memory>
#include <ostream>

#include <CLI/CLI.hpp>

#include "server/cli/clip_output.h"
#include "server/cli/commands.h"
#include "server/cli/face_formats.h"
#include "server/cli/face_reading_options.h"
#include "server/cli/files.h"
#include "server/cli/head_input.h"
#include "server/cli/real_range.h"

namespace semblante {
namespace {

struct ConvertCommand {
  std::string in, out;
  std::string in_format, out_format;  ///< names; empty: by the file's name
  FaceReading reading;
  FaceWriting writing;
  ClipOutput clip;
  bool quiet = false;
};

void run(ConvertCommand& options) {
  options.reading.rate = options.writing.rate;
  FaceSequence sequence = read_faces(options.in, options.in_format, options.reading);
  if (is_clip(options.out, options.out_format)) {
    options.clip.head.quiet = options.quiet;
    const std::string name = std::filesystem::path(options.in).stem().string();
    for (std::string& warning : write_clip(options.clip, sequence, name, options.out))
      sequence.warnings.push_back(std::move(warning));
    print_warnings(sequence.warnings, options.quiet);
    return;
  }
  const std::string text = write_faces(sequence, options.out, options.out_format, options.writing);
  write_file(options.out, [&text](std::ostream& out) { out << text; });
  print_warnings(sequence.warnings, options.quiet);
}

std::string list_of_formats() {
  std::string text = "\n\nFormats:";
  for (const FaceFormat& format : face_formats()) {
    text.append("\n  ").append(format.name).append(" (").append(format.extension).append("): ").append(format.meaning);
    if (format.read == nullptr) text += "; written only";
    if (format.write == nullptr) text += "; read only";
  }
  return text + "\n  glb (.glb): an animated face for any glTF viewer, of --model or --package; written only";
}

}  // namespace

void add_convert_command(CLI::App& app) {
  auto options = std::make_shared<ConvertCommand>();
  CLI::App* const command =
      app.add_subcommand("convert", "Convert faces in time from one file format to another" + list_of_formats());
  command->add_option("FILE", options->in, "File to read")->required()->envname("SEMBLANTE_IN");
  command->add_option("--out", options->out, "File to write; - is standard output")
      ->required()
      ->envname("SEMBLANTE_OUT");
  command
      ->add_option("--in-format", options->in_format, "Of FILE, if its name does not tell: " + readable_face_formats())
      ->envname("SEMBLANTE_IN_FORMAT");
  command
      ->add_option("--out-format", options->out_format,
                   "Of --out, if its name does not tell: " + writable_face_formats() + ", glb")
      ->envname("SEMBLANTE_OUT_FORMAT");
  add_face_reading_options(*command, options->reading);
  command
      ->add_option("--rate", options->writing.rate,
                   "Frames a second of a format that has a rate, and of a performance that is read; left out: that of "
                   "FILE, or told from its times, or 25")
      ->check(real_range(0.001, 1000.0))
      ->envname("SEMBLANTE_RATE");
  command
      ->add_option("--tolerance", options->writing.tolerance,
                   "How far a performance that is written may be from the frames at their times, in quantizer steps")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str()
      ->envname("SEMBLANTE_TOLERANCE");
  add_clip_options(*command, options->clip);
  command->add_flag("--quiet", options->quiet, "No warnings")->envname("SEMBLANTE_QUIET");
  command->callback([options] { run(*options); });
}

}  // namespace semblante

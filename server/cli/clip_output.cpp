#include "server/cli/clip_output.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <CLI/CLI.hpp>

#include "core/pipeline/levelled.h"
#include "protocol/clips/clip.h"
#include "protocol/package/pack_head.h"
#include "server/cli/command_failure.h"
#include "server/cli/files.h"

namespace semblante {
namespace {

constexpr std::size_t max_artefact_bytes = std::size_t{512} << 20U;
constexpr std::size_t max_rig_bytes = std::size_t{16} << 20U;

Clip clip_of(const FaceParts& parts, const ClipOutput& options, const FaceSequence& sequence, const std::string& name,
             const std::string& blamed) {
  ClipOptions clip_options;
  clip_options.name = name;
  clip_options.influences = options.influences;
  auto clip = make_clip(parts, sequence.frames, clip_options);
  if (!clip) fail(blamed, clip.error());
  return std::move(*clip);
}

Clip clip_of_folder(const ClipOutput& options, const FaceSequence& sequence, const std::string& name) {
  const std::filesystem::path folder(options.package);
  const auto mesh_drc = read_file((folder / "mesh.drc").string(), max_artefact_bytes);
  const auto weights = read_file((folder / "weights").string(), max_artefact_bytes);
  const auto rig_json = read_file((folder / "rig.json").string(), max_rig_bytes);
  FaceParts parts;
  parts.mesh_drc = mesh_drc;
  parts.weights = weights;
  parts.rig_json = {reinterpret_cast<const char*>(rig_json.data()), rig_json.size()};
  parts.image = [&folder](const Sha256& hash) -> Result<std::vector<std::uint8_t>> {
    // A level of detail is in a subfolder of the full package, which has the images of all levels.
    const auto beside = folder / "artefacts" / to_hex(hash);
    const auto above = folder / ".." / "artefacts" / to_hex(hash);
    return read_file((std::filesystem::exists(beside) ? beside : above).string(), max_artefact_bytes);
  };
  return clip_of(parts, options, sequence, name, options.package);
}

Clip clip_of_head(const ClipOutput& options, const FaceSequence& sequence, const std::string& name,
                  std::vector<std::string>& warnings) {
  Head head = load_head(options.head);
  warnings = head.all_warnings();
  PackageOptions package_options;
  package_options.name = std::filesystem::path(options.head.model_path).stem().string();
  const auto levelled = level_head(std::move(head), {});
  if (!levelled) fail(options.head.model_path, levelled.error());
  const auto packages = pack_head(*levelled, std::move(package_options));
  if (!packages) fail(options.head.model_path, packages.error());
  const FacePackage& package = packages->front();
  const auto& rig_json = package.rig_json.bytes;
  FaceParts parts;
  parts.mesh_drc = package.mesh_drc.bytes;
  parts.weights = package.weights.bytes;
  parts.rig_json = {reinterpret_cast<const char*>(rig_json.data()), rig_json.size()};
  parts.image = [&package](const Sha256& hash) -> Result<std::vector<std::uint8_t>> {
    const auto at = std::find_if(package.images.begin(), package.images.end(),
                                 [&hash](const Artefact& image) { return image.sha256 == hash; });
    if (at == package.images.end()) return Error{ErrorCode::missing, to_hex(hash), "is no image of the model"};
    return at->bytes;
  };
  return clip_of(parts, options, sequence, name, options.head.model_path);
}

}  // namespace

void add_clip_options(CLI::App& command, ClipOutput& options) {
  add_named_head_options(command, options.head);
  command
      .add_option("--package", options.package,
                  "Folder that `semblante parametrize --out` wrote, instead of --model: the face of a clip (.glb)")
      ->excludes(command.get_option("--model"))
      ->envname("SEMBLANTE_PACKAGE");
  command.add_option("--influences", options.influences, "Joints that move one vertex of a clip, at most")
      ->check(CLI::IsMember({4, 8, 12, 16}))
      ->capture_default_str()
      ->envname("SEMBLANTE_INFLUENCES");
}

bool is_clip(const std::string& path, const std::string& format) {
  return format.empty() ? std::filesystem::path(path).extension() == ".glb" : format == "glb";
}

std::vector<std::string> write_clip(const ClipOutput& options, const FaceSequence& sequence, const std::string& name,
                                    const std::string& out) {
  std::vector<std::string> warnings;
  if (options.package.empty() && options.head.model_path.empty()) {
    throw CommandFailure(CommandFailure::bad_input,
                         out + ": a clip needs a face: give --model and --points, or --package");
  }
  const Clip clip = options.package.empty() ? clip_of_head(options, sequence, name, warnings)
                                            : clip_of_folder(options, sequence, name);
  write_file(out, clip.glb);
  warnings.insert(warnings.end(), clip.warnings.begin(), clip.warnings.end());
  return warnings;
}

}  // namespace semblante

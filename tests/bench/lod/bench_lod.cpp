// Levels of detail of heads: what each weighs, how far it is from the full mesh, and what making them costs.
//   bench_lod [MODEL POINTS.json [BUDGET...]]
// Without arguments: the real heads. Without budgets: the default ones.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/expressions/library.h"
#include "core/lod/decimate.h"
#include "core/lod/level_error.h"
#include "core/lod/lod_poses.h"
#include "core/parametrize/parametrize.h"
#include "core/parametrize/place_feature_points.h"
#include "tests/oracle/real_heads.h"

namespace semblante {
namespace {

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// The 14 visemes that move: faces the decimation did not see.
std::vector<LodPose> visemes(const Rig& rig, const Model& model) {
  std::vector<semblante_frame> frames;
  for (std::uint8_t viseme = 1; viseme < viseme_library().size(); ++viseme) {
    semblante_frame& frame = frames.emplace_back();
    frame.viseme1 = viseme;
    frame.viseme_blend = SEMBLANTE_BLEND_MAX;
  }
  return poses_in(rig, model, frames);
}

SurfaceError worst_of(const std::vector<SurfaceError>& errors) {
  SurfaceError out;
  for (const SurfaceError& e : errors) {
    out.max = std::max(out.max, e.max);
    out.mean += e.mean / static_cast<double>(errors.size());
    out.rms = std::max(out.rms, e.rms);
  }
  return out;
}

void run(const std::string& name, const std::filesystem::path& file, const std::filesystem::path& points_file,
         std::vector<std::uint32_t> budgets) {
  const Model model = oracle::import_head(file);
  const Surface surface = build_surface(model);
  const auto points = place_feature_points(model, surface, oracle::read_trusted_points(points_file), nullptr);
  if (!points) {
    std::printf("%s: %s %s\n", name.c_str(), points.error().where.c_str(), points.error().message.c_str());
    return;
  }
  const double begin = seconds();
  const auto rig = parametrize(model, surface, *points);
  const double parametrized = seconds();
  const double es = 1024.0 * rig->fapu[FapuUnit::es].value_or(0.0);

  LodOptions options;
  const std::vector<LodPose> poses = lod_poses(*rig, model);
  options.poses = poses;
  const auto count = static_cast<std::uint32_t>(model.positions.size());
  options.budgets = std::move(budgets);
  if (options.budgets.empty()) options.budgets = default_budgets(count);
  const double start = seconds();
  const auto levels = decimate(model, surface, *rig, options);
  const double decimated = seconds();
  LodOptions at_rest = options;
  at_rest.poses = {};
  const auto plain = decimate(model, surface, *rig, at_rest);

  std::printf("\n%s: %zu vertices, %zu triangles; errors as shares of ES0, in 1/1000\n", name.c_str(),
              model.positions.size(), model.triangles.size());
  std::printf("parametrize %.2f s (edge, paper); all levels %.2f s\n", parametrized - begin, decimated - start);
  std::printf("%8s %9s %9s | %-17s | %-17s | %-17s | %-17s | %-15s | %s\n", "budget", "vertices", "triangles",
              "neutral", "6 expressions", "14 visemes", "expr., rest only", "uv", "flips");
  std::printf("%8s %9s %9s | %5s %5s %5s | %5s %5s %5s | %5s %5s %5s | %5s %5s %5s | %7s %7s | %4s %4s\n", "", "", "",
              "max", "mean", "rms", "max", "mean", "rms", "max", "mean", "rms", "max", "mean", "rms", "max", "mean",
              "tri", "uv");
  const std::vector<LodPose> unseen = visemes(*rig, model);
  const auto three = [es](const SurfaceError& e) {
    std::printf("| %5.1f %5.2f %5.2f ", 1000.0 * e.max / es, 1000.0 * e.mean / es, 1000.0 * e.rms / es);
  };
  for (std::size_t i = 0; i < levels->size(); ++i) {
    const LevelOfDetail& level = (*levels)[i];
    const double from = seconds();
    const LevelError error = measure_level(model, surface, level, options.poses);
    const double measured = seconds();
    std::printf("%8u %9u %9zu ", level.budget, level.vertex_count, level.triangles.size());
    three(error.neutral);
    three(worst_of(error.poses));
    three(worst_of(measure_level(model, surface, level, unseen).poses));
    three(i < plain->size() ? worst_of(measure_level(model, surface, (*plain)[i], options.poses).poses)
                            : SurfaceError{});
    std::printf("| %7.4f %7.5f | %4u %4u   measured in %.2f s\n", error.uv_max, error.uv_mean, error.flipped_triangles,
                error.flipped_uvs, measured - from);
  }
}

}  // namespace
}  // namespace semblante

int main(int argc, char** argv) {
  using namespace semblante;
  if (argc >= 3) {
    std::vector<std::uint32_t> budgets;
    for (int i = 3; i < argc; ++i) budgets.push_back(static_cast<std::uint32_t>(std::atoi(argv[i])));
    run(argv[1], argv[1], argv[2], budgets);
    return 0;
  }
  const auto folder = oracle::faces_folder();
  if (!folder) {
    std::puts("the folder of real heads is not there: give MODEL and POINTS.json");
    return 1;
  }
  run("ict-facekit", *folder / "ict-facekit/neutral.obj", *folder / "ict-facekit/ict-facekit.fps.json",
      {20000, 10000, 5000, 2500});
  run("makehuman", *folder / "makehuman/head.obj", *folder / "makehuman/makehuman.fps.json", {2500, 1500});
  run("mediapipe", *folder / "mediapipe-canonical/face_model_with_iris.obj",
      *folder / "mediapipe-canonical/mediapipe-canonical.fps.json", {300, 200});
  return 0;
}

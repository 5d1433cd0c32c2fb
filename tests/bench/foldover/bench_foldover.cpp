// bench_foldover [--full] [MODEL POINTS]...
// Skin that turns inside out, lips and lids that pass through each other or stay open: tables on standard output, of
// the known heads or of those given.

#include <cstdio>
#include <exception>
#include <span>

#include "core/expressions/library.h"
#include "core/parametrize/weight_method.h"
#include "tests/support/closure.h"
#include "tests/support/fold_over.h"
#include "tests/support/posed_face.h"

namespace semblante::bench {
namespace {

FoldOver fold_over_of(const PosedFace& face, std::uint8_t viseme, std::uint8_t expression) {
  const Model& model = face.head().model;
  return count_fold_over(model.triangles, model.positions, face.pose(frame_of(viseme, expression)));
}

void print_folds(const PosedFace& face, bool in_full) {
  const std::size_t visemes = viseme_library().size();
  const std::size_t expressions = expression_library().size();
  if (in_full) {
    std::printf("  %-8s", "");
    for (std::size_t e = 0; e < expressions; ++e)
      std::printf(" %9s", std::string(expression_library()[e].name).c_str());
    std::printf("\n");
  }
  FoldOver alone;
  FoldOver combined;
  std::size_t most = 0;
  for (std::uint8_t v = 0; v < visemes; ++v) {
    if (in_full) std::printf("  %-8s", std::string(viseme_library()[v].name).c_str());
    for (std::uint8_t e = 0; e < expressions; ++e) {
      const FoldOver folds = fold_over_of(face, v, e);
      (v == 0 || e == 0 ? alone : combined) += folds;
      most = std::max(most, folds.inverted);
      if (in_full) std::printf(" %9zu", folds.inverted);
    }
    if (in_full) std::printf("\n");
  }
  std::printf(
      "  inverted: %zu in the visemes and expressions, %zu in their combinations, at most %zu in one face of %zu "
      "triangles; degenerate: %zu, %zu\n",
      alone.inverted, combined.inverted, most, face.head().model.triangles.size(), alone.degenerate,
      combined.degenerate);
}

/// Skin about the eyes that FAPs turn inside out.
void print_eye_folds(const PosedFace& face) {
  struct Pose {
    const char* name;
    semblante_frame frame;
  };
  const std::vector<Pose> poses = {
      {"brows up", frame_of({{31, 400}, {32, 400}, {33, 400}, {34, 400}, {35, 400}, {36, 400}})},
      {"brows down", frame_of({{31, -200}, {32, -200}, {33, -200}, {34, -200}, {35, -200}, {36, -200}})},
      {"cheeks up", frame_of({{41, 300}, {42, 300}})},
      {"lids open", frame_of({{19, -512}, {20, -512}, {21, -256}, {22, -256}})},
      {"lids shut", frame_of({{19, 1024}, {20, 1024}})},
  };
  const Model& model = face.head().model;
  std::printf("  inverted:");
  for (const Pose& pose : poses)
    std::printf(" %s %zu", pose.name,
                count_fold_over(model.triangles, model.positions, face.pose(pose.frame)).inverted);
  std::printf("\n");
}

void print_closure(const PosedFace& face) {
  struct Shut {
    const char* name;
    OpeningKind kind;
    semblante_frame frame;
  };
  const std::vector<Shut> shuts = {
      {"lips at rest", OpeningKind::mouth, frame_of(0, 0)},
      {"lips in p_b_m", OpeningKind::mouth, frame_of(1, 0)},
      {"lids half shut", OpeningKind::left_eye, frame_of({{19, 512.0F}, {20, 512.0F}})},
      {"left lids shut", OpeningKind::left_eye, frame_of({{19, 1024.0F}, {20, 1024.0F}})},
      {"shut, looks up", OpeningKind::left_eye, frame_of({{19, 1024.0F}, {25, -34907.0F}})},
      {"shut, looks down", OpeningKind::left_eye, frame_of({{19, 1024.0F}, {25, 34907.0F}})},
      {"lower lid alone", OpeningKind::left_eye, frame_of({{21, 1024.0F}})},
      {"right lids shut", OpeningKind::right_eye, frame_of({{19, 1024.0F}, {20, 1024.0F}})},
  };
  for (const Shut& shut : shuts) {
    const auto opening = Opening::find(face, shut.kind);
    if (!opening) {
      std::printf("  %-16s no such opening\n", shut.name);
      continue;
    }
    const Closure c = opening->measure(face.pose(shut.frame));
    std::printf("  %-16s slit %5.1f %%  crossing %5.1f %% in %zu columns  pierced %5.1f %%\n", shut.name,
                100.0 * c.slit, 100.0 * c.crossing, c.crossing_columns, 100.0 * c.pierced);
  }
}

void run(const std::vector<Head>& heads, bool in_full) {
  for (const Head& head : heads) {
    for (const WeightMethod method : {WeightMethod::paper, WeightMethod::smooth, WeightMethod::fitted}) {
      if (method == WeightMethod::fitted && head.model.examples.empty()) continue;
      const PosedFace face(head, method);
      std::printf("%s, %s\n", head.name.c_str(),
                  std::string(weight_method_names[static_cast<std::size_t>(method)]).c_str());
      print_folds(face, in_full);
      print_eye_folds(face);
      print_closure(face);
      if (const auto leak = leak_to_upper_lip(face))
        std::printf("  upper lip moves with the lower lip by at most %.1f %%\n", 100.0 * *leak);
      std::fflush(stdout);
    }
  }
}

}  // namespace
}  // namespace semblante::bench

int main(int argc, char** argv) {
  try {
    const std::span<char*> words(argv + 1, argv + argc);
    const bool in_full = !words.empty() && std::string_view(words[0]) == "--full";
    std::vector<semblante::bench::Head> heads;
    for (std::size_t i = in_full ? 1 : 0; i + 1 < words.size(); i += 2)
      heads.push_back(semblante::bench::read_head(words[i], words[i + 1]));
    if (heads.empty()) heads = semblante::bench::known_heads();
    semblante::bench::run(heads, in_full);
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "bench_foldover: %s\n", problem.what());
    return 1;
  }
  return 0;
}

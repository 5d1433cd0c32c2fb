// How near the ARKit bridge comes to ICT-FaceKit's own shapes: a table on standard output. --fit prints the FAPs that
// come nearest to each shape.

#include <cmath>
#include <cstdio>
#include <exception>
#include <string_view>

#include "tests/bench/bridges/ict_shapes.h"
#include "tests/oracle/real_heads.h"
#include "tests/support/fold_over.h"

namespace semblante::bench {
namespace {

std::size_t inverted(const IctStudy& study, const semblante_frame& frame) {
  return count_fold_over(study.head.model.triangles, study.head.model.positions, study.face.pose(frame)).inverted;
}

void print_quality(const IctStudy& study) {
  std::printf("| shape | error | cosine | error at FPs | least error FAPs allow | inverted triangles |\n");
  std::printf("|---|---|---|---|---|---|\n");
  double mean = 0.0;
  for (const IctShape& shape : study.shapes) {
    const semblante_frame frame = frame_from_arkit(shape.coefficients).value().frame;
    const BridgeQuality quality = compare(study, study.displacement_of(frame), shape.displacement);
    const semblante_frame nearest = nearest_faps(study, shape, semblante_frame{}, 0.0);
    const BridgeQuality best = compare(study, study.displacement_of(nearest), shape.displacement);
    std::printf("| %s | %.2f | %.2f | %.2f | %.2f | %zu |\n", shape.name.c_str(), quality.error, quality.cosine,
                quality.point_error, best.error, inverted(study, frame));
    mean += quality.error / static_cast<double>(study.shapes.size());
  }
  std::printf("| mean | %.2f | | | | |\n", mean);
}

void print_fits(const IctStudy& study, double pull) {
  for (const IctShape& shape : study.shapes) {
    const semblante_frame start = frame_from_arkit(shape.coefficients).value().frame;
    const semblante_frame fitted = nearest_faps(study, shape, start, pull);
    const BridgeQuality quality = compare(study, study.displacement_of(fitted), shape.displacement);
    std::printf("%s error %.3f inverted %zu {", shape.name.c_str(), quality.error, inverted(study, fitted));
    for (int n = 3; n <= SEMBLANTE_FAP_COUNT; ++n) {
      if (std::abs(fitted.fap[n]) >= 2.0F) std::printf("%d: %.0f, ", n, static_cast<double>(fitted.fap[n]));
    }
    std::printf("}\n");
  }
}

}  // namespace
}  // namespace semblante::bench

int main(int argc, char** argv) {
  try {
    const auto faces = semblante::oracle::faces_folder();
    if (!faces) {
      std::printf("no folder of real heads\n");
      return 0;
    }
    const semblante::bench::IctStudy study(*faces / "ict-facekit");
    if (argc > 1 && std::string_view(argv[1]) == "--fit") {
      semblante::bench::print_fits(study, argc > 2 ? std::stod(argv[2]) : 0.1);
    } else {
      semblante::bench::print_quality(study);
    }
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "bench_bridges: %s\n", problem.what());
    return 1;
  }
  return 0;
}

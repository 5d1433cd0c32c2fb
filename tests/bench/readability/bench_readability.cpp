// What visemes and expressions look like in figures, alone and together: tables on standard output.

#include <cstdio>
#include <exception>
#include <string>
#include <string_view>

#include "core/expressions/library.h"
#include "core/parametrize/weight_method.h"
#include "tests/bench/readability/face_reading.h"
#include "tests/bench/readability/mouth_shape.h"

namespace semblante::bench {
namespace {

std::string viseme_name(std::size_t v) { return std::string(viseme_library()[v].name); }
std::string expression_name(std::size_t e) { return std::string(expression_library()[e].name); }

void print_expression_heads() {
  std::printf("  %-9s", "");
  for (std::size_t e = 0; e < FaceReading::expressions; ++e) std::printf(" %17s", expression_name(e).c_str());
  std::printf("\n");
}

void print_mouths(const PosedFace& face, const FaceReading& reading) {
  const auto mouth = Mouth::find(face);
  if (!mouth) {
    std::printf("  no mouth that opens\n");
    return;
  }
  std::printf("  opening (%% of MNS0), width (%% of rest), protrusion (%% of MNS0)\n");
  print_expression_heads();
  for (std::size_t v = 0; v < FaceReading::visemes; ++v) {
    std::printf("  %-9s", viseme_name(v).c_str());
    for (std::size_t e = 0; e < FaceReading::expressions; ++e) {
      const MouthShape s = mouth->measure(reading.pose(v, e));
      std::printf("   %5.1f %4.0f %4.0f", 100 * s.opening, 100 * s.width, 100 * s.protrusion);
    }
    std::printf("\n");
  }
  std::printf(
      "  p_b_m: slit, crossing (%% of MNS0); f_v: teeth to lower lip (%% of MNS0), at rest and in p_b_m beside\n");
  std::printf("  %-9s", "p_b_m");
  for (std::size_t e = 0; e < FaceReading::expressions; ++e) {
    const Closure c = mouth->closure(reading.pose(1, e));
    std::printf("      %5.1f %5.1f", 100 * c.slit, 100 * c.crossing);
  }
  std::printf("\n");
  for (const std::size_t v : {0U, 1U, 2U}) {
    std::printf("  %-9s", viseme_name(v).c_str());
    for (std::size_t e = 0; e < FaceReading::expressions; ++e) {
      std::printf(" %17.1f", 100 * mouth->teeth_to_lower_lip(reading.pose(v, e)).value_or(-0.01));
    }
    std::printf("\n");
  }
  double worst = 0.0;
  std::string where;
  for (std::size_t v = 0; v < FaceReading::visemes; ++v) {
    for (std::size_t e = 0; e < FaceReading::expressions; ++e) {
      const double crossing = mouth->closure(reading.pose(v, e)).crossing;
      if (crossing <= worst) continue;
      worst = crossing;
      where = viseme_name(v) + " + " + expression_name(e);
    }
  }
  std::printf("  lips reach into each other by at most %.1f %% (%s)\n", 100 * worst, where.c_str());
}

void print_reading(const FaceReading& reading) {
  std::printf("  read as, where not right; viseme, expression with their distances, right and next\n");
  for (std::size_t v = 0; v < FaceReading::visemes; ++v) {
    for (std::size_t e = 0; e < FaceReading::expressions; ++e) {
      const auto viseme = reading.read_viseme(v, e);
      const auto expression = reading.read_expression(v, e);
      if (v != 0 && viseme.entry != v) {
        std::printf("  %s + %s: mouth of %s (%.4f, %.4f)\n", viseme_name(v).c_str(), expression_name(e).c_str(),
                    viseme_name(viseme.entry).c_str(), viseme.distance,
                    reading.distance(reading.pose(v, e), reading.pose(v, 0), FaceReading::Region::mouth));
      }
      if (expression.entry != e) {
        std::printf("  %s + %s: face of %s\n", viseme_name(v).c_str(), expression_name(e).c_str(),
                    expression_name(expression.entry).c_str());
      }
    }
  }
  std::printf("  distance of expressions (%% of ES0): alone, least with a viseme\n");
  for (std::size_t a = 0; a < FaceReading::expressions; ++a) {
    for (std::size_t b = a + 1; b < FaceReading::expressions; ++b) {
      double least = 1e9;
      for (std::size_t v = 0; v < FaceReading::visemes; ++v) {
        least = std::min(least, reading.distance(reading.pose(v, a), reading.pose(v, b)));
      }
      std::printf("  %9s %-9s %6.2f %6.2f\n", expression_name(a).c_str(), expression_name(b).c_str(),
                  100 * reading.distance(reading.pose(0, a), reading.pose(0, b)), 100 * least);
    }
  }
  std::printf("  distance of the mouths of visemes (%% of ES0)\n  %-9s", "");
  for (std::size_t v = 0; v < FaceReading::visemes; ++v) std::printf(" %7s", viseme_name(v).c_str());
  std::printf("\n");
  for (std::size_t a = 0; a < FaceReading::visemes; ++a) {
    std::printf("  %-9s", viseme_name(a).c_str());
    for (std::size_t b = 0; b < FaceReading::visemes; ++b) {
      std::printf(" %7.2f", 100 * reading.distance(reading.pose(a, 0), reading.pose(b, 0), FaceReading::Region::mouth));
    }
    std::printf("\n");
  }
}

void run(const std::string& only, bool paper) {
  for (const Head& head : known_heads()) {
    if (!only.empty() && head.name.find(only) == std::string::npos) continue;
    const PosedFace face(head, paper ? WeightMethod::paper : WeightMethod::smooth);
    const FaceReading reading(face);
    std::printf("%s\n", head.name.c_str());
    print_mouths(face, reading);
    print_reading(reading);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace semblante::bench

int main(int argc, char** argv) {
  try {
    std::string only;
    bool paper = false;
    for (int i = 1; i < argc; ++i) {
      if (std::string_view(argv[i]) == "--paper") {
        paper = true;
      } else {
        only = argv[i];
      }
    }
    semblante::bench::run(only, paper);
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "bench_readability: %s\n", problem.what());
    return 1;
  }
  return 0;
}

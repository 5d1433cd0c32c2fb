#include "tests/bench/weights/bench_main.h"

#include <cstdio>
#include <exception>

#include "tests/oracle/real_heads.h"

namespace semblante::bench {

int run_on_ict_head(const char* program, void (*run)(const std::filesystem::path& folder)) {
  const auto faces = oracle::faces_folder();
  if (!faces) {
    std::puts("no folder of real heads: set SEMBLANTE_FACES_DIR");
    return 0;
  }
  try {
    run(*faces / "ict-facekit");
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "%s: %s\n", program, problem.what());
    return 1;
  }
  return 0;
}

}  // namespace semblante::bench

// semblante-codegen-expressions SOURCE_DIR: writes the displacement sets from core/expressions/data.
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>

#include "core/expressions/generate/render.h"

namespace {

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: semblante-codegen-expressions SOURCE_DIR\n", stderr);
    return 2;
  }
  try {
    const std::string root = argv[1];
    const auto sets = semblante::expressions::read_sets(root + "/core/expressions/data");
    write(root + "/core/expressions/generated/displacement_sets.h", semblante::expressions::render_header(sets));
    write(root + "/protocol/ts/generated/displacement_sets.ts", semblante::expressions::render_typescript(sets));
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "semblante-codegen-expressions: %s\n", fault.what());
    return 1;
  }
  return 0;
}

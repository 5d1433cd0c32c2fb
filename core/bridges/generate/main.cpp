// semblante-codegen-bridges SOURCE_DIR: writes the ARKit tables of C++ and TypeScript from core/bridges/data.
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>

#include "core/bridges/generate/render.h"

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
    std::fputs("usage: semblante-codegen-bridges SOURCE_DIR\n", stderr);
    return 2;
  }
  try {
    const std::string root = argv[1];
    const auto data = semblante::bridges::read_arkit_data(root + "/core/bridges/data/arkit.json");
    write(root + "/core/bridges/generated/arkit_tables.h", semblante::bridges::render_cpp(data));
    write(root + "/protocol/ts/generated/arkit.ts", semblante::bridges::render_typescript(data));
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "semblante-codegen-bridges: %s\n", fault.what());
    return 1;
  }
  return 0;
}

// semblante-codegen-protocol SOURCE_DIR: writes what is generated from protocol/schema.
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "protocol/codegen/render.h"

namespace {

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: semblante-codegen-protocol SOURCE_DIR\n", stderr);
    return 2;
  }
  try {
    using namespace semblante::codegen;
    const std::string root = std::string(argv[1]) + "/protocol";
    const auto schema = read_schema(root + "/schema/messages.json");
    const auto packed = read_schema(root + "/schema/packed_tables.json");
    write(root + "/cpp/generated/packed_tables.h", render_packed_cpp(packed));
    write(root + "/ts/generated/packed_tables.ts", render_packed_typescript(packed));
    write(root + "/cpp/generated/messages.h", render_cpp(schema));
    write(root + "/ts/generated/messages.ts", render_typescript(schema));
    write(root + "/SPEC.md", render_spec(schema, packed, read(root + "/SPEC.md")));
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "semblante-codegen-protocol: %s\n", fault.what());
    return 1;
  }
  return 0;
}

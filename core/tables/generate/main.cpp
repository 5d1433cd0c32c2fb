// semblante-codegen-tables SOURCE_DIR: writes the generated tables from core/tables/data.
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>

#include "core/tables/generate/render.h"

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
    std::fputs("usage: semblante-codegen-tables SOURCE_DIR\n", stderr);
    return 2;
  }
  try {
    const std::string root = argv[1];
    const semblante::tables::TableData data = semblante::tables::read_table_data(root + "/core/tables/data");
    write(root + "/core/tables/generated/mpeg4_tables.h", semblante::tables::render_c_header(data));
    write(root + "/core/tables/generated/mpeg4_entries.h", semblante::tables::render_cpp_header(data));
    write(root + "/protocol/ts/generated/mpeg4.ts", semblante::tables::render_typescript(data));
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "semblante-codegen-tables: %s\n", fault.what());
    return 1;
  }
  return 0;
}

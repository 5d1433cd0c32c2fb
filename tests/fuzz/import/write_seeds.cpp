// Writes one small valid file of each kind into <folder>/<target>/: where the fuzzers begin.
#include <filesystem>
#include <fstream>
#include <iostream>

#include "tests/unit/import/test_files.h"

namespace {

void write(const std::filesystem::path& path, const semblante::test::Bytes& bytes) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// Before and after an array of empty objects: once read in the square of their number.
semblante::test::Bytes many_objects(const std::string& before, const std::string& after) {
  std::string text = before;
  for (int i = 0; i < 1200; ++i) text += i == 0 ? "{}" : ",{}";
  return semblante::test::to_bytes(text + after);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: semblante-fuzz-seeds FOLDER\n";
    return 2;
  }
  using namespace semblante::test;
  const std::filesystem::path folder = argv[1];
  for (const NamedFile& file : all_quads()) {
    write(folder / std::string(to_string(file.format)) / file.name, file.bytes);
  }
  write(folder / "gltf" / "quad", to_bytes(quad_gltf_json()));
  write(folder / "gltf" / "many_objects", many_objects(R"({"asset":{"version":"2.0"},"extras":[)", "]}"));
  write(folder / "feature_points" / "many_objects", many_objects(R"({"points":{},"a":[)", "]}"));
  write(folder / "draco" / "sequential", quad_draco_data(false));
  write(folder / "draco" / "edgebreaker", quad_draco_data(true));
  write(folder / "feature_points" / "two",
        to_bytes(R"({"points": {"2.1": {"vertex": 7, "position": [1.5, -2, 3e1]}, "7.1": {"position": [0, 0, 0]}},
"to_mpeg4_axes": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]})"));
  write(folder / "feature_points" / "displacements", to_bytes(R"({"2.1": [0, -1, 0.5]})"));
}

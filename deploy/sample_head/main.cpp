// semblante-sample-head OUT_DIR: writes sample-head.glb and sample-head.fps.json.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "deploy/sample_head/sample_head.h"
#include "deploy/sample_head/write_sample_head.h"

namespace {

bool write_file(const std::filesystem::path& path, const char* data, std::size_t size) {
  std::ofstream out(path, std::ios::binary);
  out.write(data, static_cast<std::streamsize>(size));
  out.close();
  if (!out) std::fprintf(stderr, "semblante-sample-head: cannot write %s\n", path.c_str());
  return static_cast<bool>(out);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 || std::string_view(argv[1]).starts_with("-")) {
    std::fprintf(stderr, "usage: semblante-sample-head OUT_DIR\n");
    return 2;
  }
  const std::filesystem::path folder(argv[1]);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    std::fprintf(stderr, "semblante-sample-head: cannot make %s: %s\n", folder.c_str(), error.message().c_str());
    return 1;
  }
  const semblante::SampleHead head = semblante::make_sample_head();
  const auto glb = semblante::sample_head_glb(head);
  if (!glb) {
    std::fprintf(stderr, "semblante-sample-head: %s\n", glb.error().message.c_str());
    return 1;
  }
  const std::string points = semblante::sample_head_feature_points_json(head);
  const bool written =
      write_file(folder / "sample-head.glb", reinterpret_cast<const char*>(glb->data()), glb->size()) &&
      write_file(folder / "sample-head.fps.json", points.data(), points.size());
  return written ? 0 : 1;
}

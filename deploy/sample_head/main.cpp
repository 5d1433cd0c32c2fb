// semblante-sample-head OUT_DIR [bust|body|scan]: writes sample-head.glb and sample-head.fps.json, or those of
// sample-body or sample-scan.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

#include "deploy/sample_head/sample_head.h"
#include "deploy/sample_head/write_sample_head.h"

namespace {

/// In the order of SampleHeadForm.
constexpr std::string_view forms[] = {"bust", "body", "scan"};

bool write_file(const std::filesystem::path& path, const char* data, std::size_t size) {
  std::ofstream out(path, std::ios::binary);
  out.write(data, static_cast<std::streamsize>(size));
  out.close();
  if (!out) std::fprintf(stderr, "semblante-sample-head: cannot write %s\n", path.c_str());
  return static_cast<bool>(out);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view form_name = argc == 3 ? argv[2] : "bust";
  const auto* const form = std::find(std::begin(forms), std::end(forms), form_name);
  if (argc < 2 || argc > 3 || std::string_view(argv[1]).starts_with("-") || form == std::end(forms)) {
    std::fprintf(stderr, "usage: semblante-sample-head OUT_DIR [bust|body|scan]\n");
    return 2;
  }
  const std::filesystem::path folder(argv[1]);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    std::fprintf(stderr, "semblante-sample-head: cannot make %s: %s\n", folder.c_str(), error.message().c_str());
    return 1;
  }
  const semblante::SampleHead head =
      semblante::make_sample_head({.form = static_cast<semblante::SampleHeadForm>(form - std::begin(forms))});
  const auto glb = semblante::sample_head_glb(head);
  if (!glb) {
    std::fprintf(stderr, "semblante-sample-head: %s\n", glb.error().message.c_str());
    return 1;
  }
  const std::string points = semblante::sample_head_feature_points_json(head);
  const bool written =
      write_file(folder / (head.name + ".glb"), reinterpret_cast<const char*>(glb->data()), glb->size()) &&
      write_file(folder / (head.name + ".fps.json"), points.data(), points.size());
  return written ? 0 : 1;
}

#include "server/app/installed_files.h"

#include "server/jobs/worker_process.h"

namespace semblante {

InstalledFiles installed_files() {
  const auto data =
      (std::filesystem::path(jobs::own_executable()).parent_path() / SEMBLANTE_DATA_FROM_PROGRAM).lexically_normal();
  InstalledFiles files;
  std::error_code error;
  if (std::filesystem::is_regular_file(data / "web" / "index.html", error)) files.web_root = data / "web";
  const auto sample = data / "sample" / "sample-head.glb";
  if (std::filesystem::is_regular_file(sample, error)) files.sample = sample;
  return files;
}

std::filesystem::path sample_head_file() {
  auto installed = installed_files().sample;
  if (!installed.empty()) return installed;
  const auto folder = std::filesystem::path(jobs::own_executable()).parent_path().parent_path();
  std::error_code error;
  const auto built = folder / "sample" / "sample-head.glb";
  return std::filesystem::is_regular_file(built, error) ? built : std::filesystem::path();
}

}  // namespace semblante

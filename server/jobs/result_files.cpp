#include "server/jobs/result_files.h"

#include <bit>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <string_view>
#include <unistd.h>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/import/model_formats.h"
#include "server/store/frame_json.h"
#include "server/store/store_error.h"

namespace semblante::jobs {

static_assert(std::endian::native == std::endian::little, "`positions` is written as it lies in memory");
static_assert(sizeof(glm::vec3) == 3 * sizeof(float));

namespace {

/// Returns errno of the call that failed, or 0. An isolated worker can only create files, not open existing ones.
int write_new_file(const std::string& path, std::span<const std::uint8_t> bytes) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file < 0) return errno;
  while (!bytes.empty()) {
    const auto written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int error = errno;
      ::close(file);
      return error;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return ::close(file) == 0 ? 0 : errno;
}

}  // namespace

Status ResultFiles::write(const std::string& name, const std::string& content_type,
                          std::span<const std::uint8_t> bytes) {
  if (const int error = write_new_file(directory_ + "/" + name, bytes); error != 0) {
    store::throw_if_disk_full(name, error);
    return Error{ErrorCode::io, "", name + " cannot be written: " + std::strerror(error)};
  }
  written_.push_back({name, "", bytes.size(), content_type});
  return Unit{};
}

Status ResultFiles::write_report(const Report& report, const ModelFrame& frame, const FrameWish& wish,
                                 std::vector<ReportSection> more) {
  more.insert(more.begin(), ReportSection{"frame", store::frame_to_json(frame, wish)});
  const auto json = semblante::write_report(report, more);
  return write("report.json", "application/json", {reinterpret_cast<const std::uint8_t*>(json.data()), json.size()});
}

Status ResultFiles::write_preview(const StandingHead& head, std::span<const Part> parts) {
  const auto preview = build_preview(head.model, head.surface, parts);
  if (!preview) return preview.error();
  if (auto written = write("preview.glb", std::string(glb_media_type), *preview); !written) return written;
  const auto& positions = head.model.positions;
  return write("positions", "application/octet-stream",
               {reinterpret_cast<const std::uint8_t*>(positions.data()), positions.size() * sizeof(glm::vec3)});
}

Status ResultFiles::write_packages(std::span<const FacePackage> packages) {
  for (std::size_t lod = 0; lod < packages.size(); ++lod) {
    if (auto written = write_package(lod, packages[lod]); !written) return written;
  }
  const auto& images = packages.front().images;
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (auto written = write("image-" + std::to_string(i), images[i].mime_type, images[i].bytes); !written)
      return written;
  }
  return Unit{};
}

Status ResultFiles::write_package(std::size_t lod, const FacePackage& package) {
  struct File {
    std::string_view name, content_type;
    const Artefact& artefact;
  };
  const File files[] = {{"mesh.drc", "application/octet-stream", package.mesh_drc},
                        {"weights", "application/vnd.semblante.weights", package.weights},
                        {"rig.json", "application/json", package.rig_json},
                        {"face.glb", glb_media_type, package.face_glb}};
  for (const auto& file : files) {
    auto written = write(store::artefact_name(lod, file.name), std::string(file.content_type), file.artefact.bytes);
    if (!written) return written;
  }
  return Unit{};
}

}  // namespace semblante::jobs

#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/doctor/report.h"
#include "core/pipeline/standing.h"
#include "protocol/package/package.h"
#include "server/report/report_json.h"
#include "server/store/records.h"

namespace semblante::jobs {

/// The artefacts of one job: files in its output directory, which exists and is empty, and the list of them. All
/// functions fail with `io`, and throw store::DiskFull on a full disk.
class ResultFiles {
 public:
  explicit ResultFiles(std::string directory) : directory_(std::move(directory)) {}

  Status write(const std::string& name, const std::string& content_type, std::span<const std::uint8_t> bytes);

  /// report.json, with the frame of the head in front of `more`.
  Status write_report(const Report& report, const ModelFrame& frame, const FrameWish& wish,
                      std::vector<ReportSection> more = {});

  /// The files for display and picking before there is a package: preview.glb and `positions`.
  Status write_preview(const StandingHead& head, std::span<const Part> parts);

  /// The files of the packages, one for each level, and the images of the first.
  Status write_packages(std::span<const FacePackage> packages);

  /// The files written so far, by name; `sha256` is empty.
  [[nodiscard]] const std::vector<store::ArtefactRecord>& written() const { return written_; }

 private:
  Status write_package(std::size_t lod, const FacePackage& package);

  std::string directory_;
  std::vector<store::ArtefactRecord> written_;
};

}  // namespace semblante::jobs

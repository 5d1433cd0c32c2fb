#pragma once

#include <span>
#include <string>

#include "core/doctor/report.h"
#include "core/pipeline/standing.h"
#include "protocol/package/package.h"
#include "server/jobs/worker_protocol.h"
#include "server/report/report_json.h"

namespace semblante::jobs {

/// The artefacts of one job: files in its output directory, each listed in its result. All functions fail with `io`,
/// and throw store::DiskFull when there is no room.
class ResultFiles {
 public:
  /// Both must outlive this object.
  ResultFiles(const WorkerRequest& request, WorkerResult& result) : request_(request), result_(result) {}

  Status write(const std::string& name, const std::string& content_type, std::span<const std::uint8_t> bytes);

  /// report.json, with the frame of the head in front of `more`; its counts go into the result.
  Status write_report(const Report& report, const ModelFrame& frame, std::vector<ReportSection> more = {});

  /// What is shown and picked from before there is a package: preview.glb and `positions`.
  Status write_preview(const StandingHead& head, std::span<const Part> parts);

  /// The files of the packages, one a level, and the images of the first.
  Status write_packages(std::span<const FacePackage> packages);

 private:
  Status write_package(const FacePackage& package);

  const WorkerRequest& request_;
  WorkerResult& result_;
};

}  // namespace semblante::jobs

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "clients/native/client/face_package.h"
#include "clients/native/tools/shots.h"
#include "core/types/result.h"

namespace semblante::tools {

struct OutputOptions {
  std::filesystem::path folder;
  std::vector<std::string> formats = {"obj"};  ///< any of obj, ply, png, table
  std::string shot = "front:face";             ///< for png
  std::string size = "512x512";                ///< for png
};

/// Writes the current face, one numbered file per frame and format, and an index of them.
class FrameOutput {
 public:
  /// Creates the folder, and the renderer if "png" is requested. `face` must outlive the output. Errors:
  /// invalid_argument (an unknown format, shot or size), io, unsupported (no EGL).
  static Result<FrameOutput> create(const client::Face& face, const OutputOptions& options);
  FrameOutput(FrameOutput&&) noexcept;
  FrameOutput& operator=(FrameOutput&&) noexcept;
  ~FrameOutput();

  Status write(std::uint64_t sequence, double media_time);
  /// frames.csv: "frame,sequence,media_time_ms".
  Status finish();

 private:
  struct Impl;
  explicit FrameOutput(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace semblante::tools

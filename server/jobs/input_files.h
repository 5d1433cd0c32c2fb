#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/types/result.h"

namespace semblante::jobs {

/// The files that a job reads, open: a worker may open none once it is isolated.
class InputFiles {
 public:
  /// Opens the files. One that cannot be opened is an error when it is read.
  explicit InputFiles(const std::vector<std::string>& paths);
  ~InputFiles();
  InputFiles(const InputFiles&) = delete;
  InputFiles& operator=(const InputFiles&) = delete;

  /// The bytes of one of the files, by the path it was opened with. Error: io.
  [[nodiscard]] Result<std::vector<std::uint8_t>> read(const std::string& path) const;

 private:
  std::map<std::string, int> descriptors_;
};

}  // namespace semblante::jobs

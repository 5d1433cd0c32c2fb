#pragma once

#include <filesystem>
#include <string>

namespace semblante::test {

/// A disk that is full when a test says so, for the processes the test starts while this exists: below `folder` every
/// write and every new file or folder fails with ENOSPC, from the next system call on. By LD_PRELOAD, so that the
/// moment is exact and no file system has to be mounted. `folder` is absolute and without links.
class FullDisk {
 public:
  explicit FullDisk(const std::filesystem::path& folder);
  ~FullDisk();
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

  void fill();
  /// Also takes back fill_after_removal().
  void free();
  /// Makes the disk full as soon as a file or folder whose path contains `part` has been removed or renamed.
  void fill_after_removal(const std::string& part);
  [[nodiscard]] bool is_full() const;

 private:
  void set(char value) const;

  const std::filesystem::path flag_, trigger_;
};

}  // namespace semblante::test

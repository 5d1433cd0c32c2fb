#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>

namespace semblante::store {

/// Bytes that this process may still write on the disk of `folder`; the largest number when the system does not tell.
std::uint64_t free_bytes(const std::filesystem::path& folder);

/// Files that this process may still make there; the largest number when the system does not tell, or sets no limit.
std::uint64_t free_files(const std::filesystem::path& folder);

/// A file without content that reserves disk space. Released when the disk is full, so that a removal (which must write
/// before it frees anything) and the end of a job or a recording can still be committed. Any thread.
class DiskReserve {
 public:
  static constexpr std::uint64_t default_bytes = std::uint64_t{4} << 20U;

  explicit DiskReserve(std::filesystem::path file, std::uint64_t bytes = default_bytes);

  /// Frees the reserved space. False when it was not reserved.
  bool release();
  /// Reserves the space again, if necessary. Throws DiskFull or StoreError.
  void fill();

 private:
  [[nodiscard]] bool is_full() const;

  std::mutex mutex_;
  const std::filesystem::path file_;
  const std::uint64_t bytes_;
};

}  // namespace semblante::store

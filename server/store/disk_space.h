#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>

namespace semblante::store {

/// Bytes that this process may still write on the disk of `folder`; the largest number when the system does not say.
std::uint64_t free_bytes(const std::filesystem::path& folder);

/// A file that only takes room. Freed when the disk is full, so that a removal, which must write before it frees
/// anything, and the end of a job or a recording can still be committed. Any thread.
class DiskReserve {
 public:
  static constexpr std::uint64_t default_bytes = std::uint64_t{4} << 20U;

  explicit DiskReserve(std::filesystem::path file, std::uint64_t bytes = default_bytes);

  /// Frees the room. False when it was free already.
  bool release();
  /// Takes the room, if it has not. Throws DiskFull or StoreError.
  void fill();

 private:
  [[nodiscard]] bool is_full() const;

  std::mutex mutex_;
  const std::filesystem::path file_;
  const std::uint64_t bytes_;
};

}  // namespace semblante::store

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "core/types/result.h"

namespace semblante::recordings {

/// Random access to the bytes of a file, or of memory. Any thread.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  [[nodiscard]] virtual std::uint64_t size() const = 0;
  /// Fills `to` from `offset` on; false when the disk fails or there are too few bytes.
  [[nodiscard]] virtual bool read(std::uint64_t offset, std::span<std::uint8_t> to) const = 0;
};

/// The first `size` bytes of a file with its current size (all, if it has fewer): the durable part of a growing file.
Result<std::shared_ptr<const ByteSource>> open_bytes(const std::filesystem::path& path,
                                                     std::uint64_t size = UINT64_MAX);
std::shared_ptr<const ByteSource> bytes_in_memory(std::vector<std::uint8_t> bytes);

}  // namespace semblante::recordings

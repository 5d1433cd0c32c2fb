#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/types/result.h"

struct zip;

namespace semblante::import {

/// A zip in memory, read only. Never writes files.
class ZipArchive {
 public:
  /// `bytes` must outlive the archive. Refuses too many entries before libzip allocates a list of them.
  static Result<ZipArchive> open(std::span<const std::uint8_t> bytes);

  /// Names of all entries except folders.
  [[nodiscard]] std::vector<std::string> names() const;
  /// Inflates the entry with exactly this name, at most `max_bytes`.
  [[nodiscard]] Result<std::vector<std::uint8_t>> read(const std::string& name, std::size_t max_bytes) const;

 private:
  struct Close {
    void operator()(zip* archive) const;
  };
  explicit ZipArchive(zip* archive) : archive_(archive) {}
  std::unique_ptr<zip, Close> archive_;
};

}  // namespace semblante::import

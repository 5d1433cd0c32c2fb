#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/types/result.h"

struct zip;

namespace semblante::import {

/// A zip in memory, read only. Never writes files.
class ZipArchive {
 public:
  /// `bytes` must outlive the archive. Refuses too many entries before libzip allocates a list of them. At most
  /// `max_total_bytes` are inflated from all entries together, those included that are refused afterwards: a model
  /// could refer to one such entry thousands of times.
  static Result<ZipArchive> open(std::span<const std::uint8_t> bytes, std::size_t max_total_bytes);

  /// Names of all entries except folders, with slashes. Of several with one name only the first is read.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  /// Inflates the entry with exactly this name, at most `max_bytes`.
  [[nodiscard]] Result<std::vector<std::uint8_t>> read(const std::string& name, std::size_t max_bytes);

 private:
  struct Close {
    void operator()(zip* archive) const;
  };
  ZipArchive(zip* archive, std::size_t max_total_bytes);
  std::unique_ptr<zip, Close> archive_;
  std::vector<std::string> names_;
  std::unordered_map<std::string, std::uint64_t> entries_;  ///< number in the archive by name
  std::size_t max_total_bytes_;
  std::size_t left_;  ///< of them
};

}  // namespace semblante::import

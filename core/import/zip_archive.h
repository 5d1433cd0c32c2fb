#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/result.h"

struct zip;

namespace semblante::import {

/// A zip in memory, read only. Nothing of it is ever written anywhere.
class ZipArchive {
 public:
  /// `bytes` must outlive the archive. Refuses more entries than a model can need before libzip makes a list of them.
  static Result<ZipArchive> open(std::span<const std::uint8_t> bytes);

  /// Names of all entries, folders left out.
  [[nodiscard]] std::vector<std::string> names() const;
  /// Inflates the entry of exactly this name, at most `max_bytes` of it.
  [[nodiscard]] Result<std::vector<std::uint8_t>> read(const std::string& name, std::size_t max_bytes) const;

 private:
  struct Close {
    void operator()(zip* archive) const;
  };
  explicit ZipArchive(zip* archive) : archive_(archive) {}
  std::unique_ptr<zip, Close> archive_;
};

/// The entry a relative URI names, seen from an entry in `folder` ("" or "a/b/"): percent codes decoded, "." and ".."
/// followed. nullopt for anything that leaves the zip: schemes, absolute paths, backslashes, ".." above the top.
std::optional<std::string> resolve_in_zip(std::string_view folder, std::string_view uri);

}  // namespace semblante::import

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace semblante::import {

struct ImageSize {
  std::size_t width = 0, height = 0;
  [[nodiscard]] std::size_t pixels() const { return width * height; }
};

/// The size that the header of a PNG or a JPEG declares, each side below 2^32. Nothing is decoded. Nothing for other
/// bytes, and where there is no such header: viewers show nothing of those either.
std::optional<ImageSize> declared_size(std::span<const std::uint8_t> bytes);

}  // namespace semblante::import

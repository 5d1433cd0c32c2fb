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

/// The size that the header of a PNG or a JPEG declares, each side below 2^32; nullopt for other bytes, and for an
/// image without a complete header. Nothing is decoded.
std::optional<ImageSize> declared_size(std::span<const std::uint8_t> bytes);

/// Whether the image is a PNG with opacity: a channel of it, or colours that are transparent.
bool has_alpha(std::span<const std::uint8_t> bytes);

}  // namespace semblante::import

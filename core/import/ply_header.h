#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/types/result.h"

namespace semblante::import {

enum class PlyType : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };
std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::f32;       ///< type of the value, or of each item of a list
  std::optional<PlyType> list_size;  ///< type of the length of a list; empty: not a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;  ///< as declared; not checked here
  std::vector<PlyProperty> properties;

  [[nodiscard]] std::optional<std::size_t> find(std::string_view property) const;
  /// Minimum number of bytes of one element, in text (a digit and a blank per value) or in binary.
  [[nodiscard]] std::size_t least_bytes(bool is_text) const;
};

struct PlyHeader {
  bool is_text = false;
  std::endian order = std::endian::little;
  std::vector<PlyElement> elements;
  std::size_t data_offset = 0;  ///< first byte after "end_header" and its line end
  std::size_t line_count = 0;   ///< lines of the header
};

/// Reads "ply" to "end_header". Bounded: at most 64 elements of at most 256 properties. Errors have the line.
Result<PlyHeader> parse_ply_header(std::span<const std::uint8_t> bytes);

}  // namespace semblante::import

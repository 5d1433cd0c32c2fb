#include "core/import/gltf_container.h"

#include <optional>

#include "core/import/text.h"

namespace semblante::import {
namespace {

constexpr std::size_t glb_header_bytes = 12;
constexpr std::size_t chunk_header_bytes = 8;
constexpr std::uint32_t magic_gltf = 0x46546C67;
constexpr std::uint32_t chunk_json = 0x4E4F534A;
constexpr std::uint32_t chunk_bin = 0x004E4942;

std::uint32_t u32_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint32_t>(bytes[at]) | static_cast<std::uint32_t>(bytes[at + 1]) << 8 |
         static_cast<std::uint32_t>(bytes[at + 2]) << 16 | static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

Error error_at(ErrorCode code, std::size_t byte, std::string message) {
  return {code, "byte " + std::to_string(byte), std::move(message)};
}

/// Value of a base64 digit, standard or URL-safe; -1 for anything else.
int base64_value(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  if (c == '/' || c == '_') return 63;
  return -1;
}

}  // namespace

Result<GlbChunks> split_glb(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < glb_header_bytes) {
    return error_at(ErrorCode::truncated, bytes.size(), "the file ends within the GLB header of 12 bytes");
  }
  if (u32_at(bytes, 0) != magic_gltf)
    return error_at(ErrorCode::malformed, 0, "not a GLB file: it does not begin with 'glTF'");
  if (const std::uint32_t version = u32_at(bytes, 4); version != 2) {
    return error_at(ErrorCode::unsupported, 4,
                    "glTF version " + std::to_string(version) + " is not supported, only version 2");
  }
  const std::uint32_t length = u32_at(bytes, 8);
  if (length > bytes.size()) {
    return error_at(
        ErrorCode::truncated, 8,
        "the GLB header declares " + std::to_string(length) + " bytes, the file has " + std::to_string(bytes.size()));
  }
  if (length < glb_header_bytes + chunk_header_bytes) return error_at(ErrorCode::truncated, 8, "the GLB has no chunk");
  bytes = bytes.first(length);

  std::optional<std::string_view> json;
  std::optional<std::span<const std::uint8_t>> binary;
  std::size_t at = glb_header_bytes;
  while (at + chunk_header_bytes <= bytes.size()) {
    const std::uint32_t size = u32_at(bytes, at);
    const std::uint32_t type = u32_at(bytes, at + 4);
    if (size > bytes.size() - at - chunk_header_bytes) {
      return error_at(ErrorCode::truncated, at,
                      "a chunk declares " + std::to_string(size) + " bytes, only " +
                          std::to_string(bytes.size() - at - chunk_header_bytes) + " are left");
    }
    const auto data = bytes.subspan(at + chunk_header_bytes, size);
    if (!json) {
      if (type != chunk_json) return error_at(ErrorCode::malformed, at + 4, "the first chunk of a GLB must be JSON");
      json = as_text(data);
      // The standard's padding is spaces; some exporters pad with NUL bytes.
      while (!json->empty() && json->back() == '\0') json->remove_suffix(1);
    } else if (type == chunk_bin && !binary) {
      binary = data;
    }
    at += chunk_header_bytes + size;
  }
  // `length` leaves room for one chunk header, so the loop ran and the first chunk was JSON.
  return GlbChunks{*json, binary.value_or(std::span<const std::uint8_t>{})};
}

Result<std::vector<std::uint8_t>> decode_data_uri(std::string_view uri, std::size_t max_bytes) {
  const std::size_t comma = uri.find(',');
  constexpr std::string_view marker = ";base64";
  if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(marker)) {
    return Error{ErrorCode::unsupported, "", "is a data: URI that is not base64"};
  }
  std::string_view digits = uri.substr(comma + 1);
  while (!digits.empty() && digits.back() == '=') digits.remove_suffix(1);
  if (digits.size() / 4 * 3 > max_bytes) return Error{ErrorCode::too_large, "", "is a data: URI that is too large"};
  std::vector<std::uint8_t> bytes;
  bytes.reserve(digits.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int bit_count = 0;
  for (const char c : digits) {
    const int value = base64_value(c);
    if (value < 0) return Error{ErrorCode::malformed, "", "is a data: URI with a character that is not base64"};
    bits = (bits << 6 | static_cast<std::uint32_t>(value)) & 0xFFFFFU;
    bit_count += 6;
    if (bit_count >= 8) {
      bit_count -= 8;
      bytes.push_back(static_cast<std::uint8_t>(bits >> bit_count));
    }
  }
  return bytes;
}

}  // namespace semblante::import

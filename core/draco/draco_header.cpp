#include "core/draco/draco_header.h"

#include <string>

namespace semblante {
namespace {

/// Reads the few numbers at the head of a Draco stream. Every read checks the end; `ok` turns false once and stays.
struct HeadReader {
  std::span<const std::uint8_t> bytes;
  bool ok = true;

  std::uint8_t byte() {
    if (bytes.empty()) {
      ok = false;
      return 0;
    }
    const std::uint8_t value = bytes.front();
    bytes = bytes.subspan(1);
    return value;
  }
  void skip(std::uint64_t count) {
    ok = ok && count <= bytes.size();
    bytes = ok ? bytes.subspan(static_cast<std::size_t>(count)) : std::span<const std::uint8_t>{};
  }
  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 35; shift += 7) {
      const std::uint8_t next = byte();
      value |= static_cast<std::uint64_t>(next & 0x7FU) << shift;
      if ((next & 0x80U) == 0) return value;
    }
    ok = false;
    return 0;
  }
  /// Names, values and nested metadata. Draco reads these by recursion, so depth and number are bounded here.
  void skip_metadata(int depth) {
    constexpr int max_depth = 8;
    ok = ok && depth < max_depth;
    const std::uint64_t entries = ok ? varint() : 0;
    for (std::uint64_t i = 0; i < entries && ok; ++i) {
      skip(byte());
      skip(varint());
    }
    const std::uint64_t children = ok ? varint() : 0;
    for (std::uint64_t i = 0; i < children && ok; ++i) {
      skip(byte());
      skip_metadata(depth + 1);
    }
  }
};

}  // namespace

Result<DracoCounts> announced_counts(std::span<const std::uint8_t> bytes) {
  HeadReader head{bytes};
  for (const char expected : {'D', 'R', 'A', 'C', 'O'}) {
    if (head.byte() != static_cast<std::uint8_t>(expected)) {
      return Error{ErrorCode::malformed, "", "is not Draco data"};
    }
  }
  const int major = head.byte();
  const int minor = head.byte();
  if (head.ok && (major != 2 || minor != 2)) {
    return Error{ErrorCode::unsupported, "",
                 "has Draco bitstream version " + std::to_string(major) + "." + std::to_string(minor) +
                     ", but only 2.2 is supported"};
  }
  constexpr std::uint8_t triangular_mesh = 1;
  if (const auto type = head.byte(); head.ok && type != triangular_mesh) {
    return Error{ErrorCode::unsupported, "", "is Draco data, but not a triangle mesh"};
  }
  const std::uint8_t method = head.byte();
  const unsigned flags = head.byte() | static_cast<unsigned>(head.byte()) << 8U;
  constexpr unsigned has_metadata = 0x8000;
  if ((flags & has_metadata) != 0) {
    const std::uint64_t attributes = head.varint();
    for (std::uint64_t i = 0; i < attributes && head.ok; ++i) {
      head.varint();
      head.skip_metadata(0);
    }
    head.skip_metadata(0);
  }
  DracoCounts announced;
  if (method == 0) {  // sequential
    announced.faces = head.varint();
    announced.points = head.varint();
  } else if (method == 1) {  // edgebreaker
    head.byte();             // kind of traversal
    announced.points = head.varint();
    announced.faces = head.varint();
  } else {
    return Error{ErrorCode::unsupported, "", "uses an unsupported Draco encoding method"};
  }
  if (!head.ok) return Error{ErrorCode::truncated, "", "has Draco data that ends within its header"};
  return announced;
}

}  // namespace semblante

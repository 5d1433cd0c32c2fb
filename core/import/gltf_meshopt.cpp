#include "core/import/gltf_meshopt.h"

#include <meshoptimizer.h>
#include <string>

namespace semblante::import {
namespace {

using Mode = MeshoptLayout::Mode;
using Filter = MeshoptLayout::Filter;

/// The library asserts the extension's conditions for these numbers, and does not check them in a release build.
Status check(const MeshoptLayout& layout) {
  const std::string stride = "byteStride " + std::to_string(layout.stride);
  if (layout.mode != Mode::attributes) {
    if (layout.stride != 2 && layout.stride != 4)
      return Error{ErrorCode::malformed, "", "has " + stride + ", but indices have 2 or 4 bytes"};
    if (layout.mode == Mode::triangles && layout.count % 3 != 0)
      return Error{ErrorCode::malformed, "", "has a count of triangle indices that is not a multiple of 3"};
    if (layout.filter != Filter::none) return Error{ErrorCode::malformed, "", "has a filter for indices"};
    return Unit{};
  }
  if (layout.stride == 0 || layout.stride > 256 || layout.stride % 4 != 0)
    return Error{ErrorCode::malformed, "", "has " + stride + ", but it must be a multiple of 4 up to 256"};
  if (layout.filter == Filter::octahedral && layout.stride != 4 && layout.stride != 8)
    return Error{ErrorCode::malformed, "", "has " + stride + ", but the filter OCTAHEDRAL needs 4 or 8"};
  if (layout.filter == Filter::quaternion && layout.stride != 8)
    return Error{ErrorCode::malformed, "", "has " + stride + ", but the filter QUATERNION needs 8"};
  return Unit{};
}

/// The maximum number of elements in this many bytes. Attributes: each byte of an element takes at least 2 bits per 16
/// elements; indices: at least one byte per triangle, or one byte per index.
std::size_t most_elements(const MeshoptLayout& layout, std::size_t bytes) {
  switch (layout.mode) {
    case Mode::attributes:
      return bytes / layout.stride * 64 + 256;
    case Mode::triangles:
      return 3 * bytes;
    case Mode::indices:
      return bytes;
  }
  return 0;
}

bool decode(std::span<const std::uint8_t> bytes, const MeshoptLayout& layout, std::uint8_t* out) {
  switch (layout.mode) {
    case Mode::attributes:
      return meshopt_decodeVertexBuffer(out, layout.count, layout.stride, bytes.data(), bytes.size()) == 0;
    case Mode::triangles:
      return meshopt_decodeIndexBuffer(out, layout.count, layout.stride, bytes.data(), bytes.size()) == 0;
    case Mode::indices:
      return meshopt_decodeIndexSequence(out, layout.count, layout.stride, bytes.data(), bytes.size()) == 0;
  }
  return false;
}

void apply_filter(const MeshoptLayout& layout, std::uint8_t* bytes) {
  switch (layout.filter) {
    case Filter::none:
      return;
    case Filter::octahedral:
      return meshopt_decodeFilterOct(bytes, layout.count, layout.stride);
    case Filter::quaternion:
      return meshopt_decodeFilterQuat(bytes, layout.count, layout.stride);
    case Filter::exponential:
      return meshopt_decodeFilterExp(bytes, layout.count, layout.stride);
  }
}

}  // namespace

MeshoptLayout read_meshopt_layout(const JsonCursor& extension) {
  MeshoptLayout layout;
  layout.count = extension.member("count").integer(0, std::uint64_t{1} << 32U);
  layout.stride = extension.member("byteStride").integer(0, 256);
  const std::string mode = extension.member("mode").text();
  if (mode == "TRIANGLES") {
    layout.mode = Mode::triangles;
  } else if (mode == "INDICES") {
    layout.mode = Mode::indices;
  } else if (mode != "ATTRIBUTES") {
    extension.member("mode").fail(ErrorCode::unsupported, "must be ATTRIBUTES, TRIANGLES or INDICES");
  }
  const std::string filter = extension.text_or("filter", "NONE");
  if (filter == "OCTAHEDRAL") {
    layout.filter = Filter::octahedral;
  } else if (filter == "QUATERNION") {
    layout.filter = Filter::quaternion;
  } else if (filter == "EXPONENTIAL") {
    layout.filter = Filter::exponential;
  } else if (filter != "NONE") {
    extension.member("filter").fail(ErrorCode::unsupported, "must be NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL");
  }
  return layout;
}

Result<std::vector<std::uint8_t>> decode_meshopt(std::span<const std::uint8_t> bytes, const MeshoptLayout& layout,
                                                 std::size_t max_bytes) {
  if (const Status status = check(layout); !status) return status.error();
  if (layout.count > most_elements(layout, bytes.size())) {
    return Error{ErrorCode::malformed, "",
                 "declares " + std::to_string(layout.count) + " elements, more than " + std::to_string(bytes.size()) +
                     " bytes of meshopt data can contain"};
  }
  if (layout.count > max_bytes / layout.stride) {
    return Error{ErrorCode::too_large, "",
                 "has meshopt data that decodes to more than " + std::to_string(max_bytes) + " bytes"};
  }
  std::vector<std::uint8_t> decoded(layout.count * layout.stride);
  if (layout.count == 0) return decoded;
  if (!decode(bytes, layout, decoded.data()))
    return Error{ErrorCode::malformed, "", "has meshopt data that cannot be decoded"};
  apply_filter(layout, decoded.data());
  return decoded;
}

}  // namespace semblante::import

#include "core/import/gltf_draco.h"

#include <cmath>
#include <new>
#include <optional>

#include <draco/compression/decode.h>

namespace semblante::import {
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

struct Announced {
  std::uint64_t faces = 0;
  std::uint64_t points = 0;
};

/// What a stream says it holds, without decoding it: bitstream 2.2, the one KHR_draco_mesh_compression allows.
Result<Announced> read_head(std::span<const std::uint8_t> bytes) {
  HeadReader head{bytes};
  for (const char expected : {'D', 'R', 'A', 'C', 'O'}) {
    if (head.byte() != static_cast<std::uint8_t>(expected)) {
      return Error{ErrorCode::malformed, "", "is not Draco data"};
    }
  }
  const int major = head.byte();
  const int minor = head.byte();
  if (head.ok && (major != 2 || minor != 2)) {
    return Error{
        ErrorCode::unsupported, "",
        "is of Draco bitstream version " + std::to_string(major) + "." + std::to_string(minor) + ", glTF allows 2.2"};
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
  Announced announced;
  if (method == 0) {  // sequential
    announced.faces = head.varint();
    announced.points = head.varint();
  } else if (method == 1) {  // edgebreaker
    head.byte();             // kind of traversal
    announced.points = head.varint();
    announced.faces = head.varint();
  } else {
    return Error{ErrorCode::unsupported, "", "uses an unknown Draco method"};
  }
  if (!head.ok) return Error{ErrorCode::truncated, "", "has Draco data that ends in its header"};
  return announced;
}

/// The types an accessor can have. Draco knows more, and reading its bool from a byte that is neither 0 nor 1 is
/// undefined.
bool is_gltf_type(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
    case draco::DT_UINT8:
    case draco::DT_INT16:
    case draco::DT_UINT16:
    case draco::DT_UINT32:
    case draco::DT_FLOAT32:
      return true;
    default:
      return false;
  }
}

double largest_of(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
      return 127.0;
    case draco::DT_UINT8:
      return 255.0;
    case draco::DT_INT16:
      return 32767.0;
    case draco::DT_UINT16:
      return 65535.0;
    default:
      return 1.0;
  }
}

}  // namespace

DracoMesh::DracoMesh(std::unique_ptr<draco::Mesh> mesh) : mesh_(std::move(mesh)) {}
DracoMesh::DracoMesh(DracoMesh&&) noexcept = default;
DracoMesh& DracoMesh::operator=(DracoMesh&&) noexcept = default;
DracoMesh::~DracoMesh() = default;

Result<DracoMesh> DracoMesh::decode(std::span<const std::uint8_t> bytes, const ImportLimits& limits) {
  const auto announced = read_head(bytes);
  if (!announced) return announced.error();
  // A face of the most regular mesh still costs about a bit; 64 of them in a byte is a lie, told to make us allocate.
  constexpr std::uint64_t max_per_byte = 64;
  const std::uint64_t plausible = max_per_byte * bytes.size();
  if (announced->faces > plausible || announced->points > plausible) {
    return Error{ErrorCode::malformed, "",
                 "announces " + std::to_string(announced->faces) + " faces and " + std::to_string(announced->points) +
                     " points in " + std::to_string(bytes.size()) + " bytes of Draco data"};
  }
  if (announced->faces > limits.max_triangles || announced->points > limits.max_vertices) {
    return Error{ErrorCode::too_large, "",
                 "announces " + std::to_string(announced->faces) + " faces and " + std::to_string(announced->points) +
                     " points of Draco data"};
  }
  std::unique_ptr<draco::Mesh> mesh;
  try {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) return Error{ErrorCode::malformed, "", "has Draco data that does not decode"};
    mesh = std::move(decoded).value();
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::too_large, "", "has Draco data that wants more memory than there is"};
  } catch (const std::length_error&) {
    return Error{ErrorCode::malformed, "", "has Draco data that wants more memory than there can be"};
  }
  if (mesh == nullptr || mesh->num_faces() > limits.max_triangles || mesh->num_points() > limits.max_vertices) {
    return Error{ErrorCode::too_large, "", "has Draco data that decodes to more than the limit"};
  }
  for (draco::FaceIndex f(0); f < mesh->num_faces(); ++f) {
    for (const draco::PointIndex& point : mesh->face(f)) {
      if (point.value() >= mesh->num_points()) {
        return Error{ErrorCode::out_of_range, "",
                     "has Draco data whose face " + std::to_string(f.value()) + " names point " +
                         std::to_string(point.value()) + ", there are " + std::to_string(mesh->num_points())};
      }
    }
  }
  return DracoMesh(std::move(mesh));
}

std::uint32_t DracoMesh::point_count() const { return mesh_->num_points(); }

std::vector<std::uint32_t> DracoMesh::indices() const {
  std::vector<std::uint32_t> indices;
  indices.reserve(std::size_t{3} * mesh_->num_faces());
  for (draco::FaceIndex f(0); f < mesh_->num_faces(); ++f) {
    for (const draco::PointIndex& point : mesh_->face(f)) indices.push_back(point.value());
  }
  return indices;
}

Result<std::vector<float>> DracoMesh::floats(std::uint32_t unique_id, std::size_t components, bool normalized) const {
  const draco::PointAttribute* const attribute = mesh_->GetAttributeByUniqueId(unique_id);
  if (attribute == nullptr || attribute->buffer() == nullptr) {
    return Error{ErrorCode::missing, "", "names Draco attribute " + std::to_string(unique_id) + ", which is not there"};
  }
  if (attribute->num_components() != components) {
    return Error{ErrorCode::mismatch, "",
                 "names a Draco attribute of " + std::to_string(int{attribute->num_components()}) +
                     " components, it needs " + std::to_string(components)};
  }
  if (!is_gltf_type(attribute->data_type())) {
    return Error{ErrorCode::unsupported, "", "names a Draco attribute of a type that glTF does not have"};
  }
  const auto stride = static_cast<std::uint64_t>(attribute->byte_stride());
  const std::uint64_t element = components * static_cast<std::uint64_t>(draco::DataTypeLength(attribute->data_type()));
  const std::uint64_t available = attribute->buffer()->data_size();
  if (!attribute->is_mapping_identity() && attribute->indices_map_size() < mesh_->num_points()) {
    return Error{ErrorCode::malformed, "", "has Draco data with points that have no value"};
  }
  const float scale =
      normalized && !attribute->normalized() ? static_cast<float>(largest_of(attribute->data_type())) : 1.0F;
  std::vector<float> values(components * mesh_->num_points());
  for (draco::PointIndex point(0); point < mesh_->num_points(); ++point) {
    const draco::AttributeValueIndex value = attribute->mapped_index(point);
    float* const out = values.data() + components * point.value();
    if (value.value() * stride + static_cast<std::uint64_t>(attribute->byte_offset()) + element > available ||
        !attribute->ConvertValue<float>(value, static_cast<std::int8_t>(components), out)) {
      return Error{ErrorCode::malformed, "", "has Draco data with points that have no value"};
    }
    for (std::size_t c = 0; c < components; ++c) {
      if (!std::isfinite(out[c])) {
        return Error{ErrorCode::not_finite, "", "has Draco data with a number that is not finite"};
      }
      if (scale != 1.0F) out[c] = std::max(out[c] / scale, -1.0F);
    }
  }
  return values;
}

}  // namespace semblante::import

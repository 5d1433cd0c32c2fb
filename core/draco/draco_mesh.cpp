#include "core/draco/draco_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>

#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>

#include "core/draco/draco_header.h"

namespace semblante {
namespace {

/// Whether glTF and face packages use the type. Draco has more types, and reading its bool from a byte that is neither
/// 0 nor 1 is undefined behaviour.
bool is_readable(draco::DataType type) {
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

Result<DracoMesh> DracoMesh::decode(std::span<const std::uint8_t> bytes, const DracoLimits& limits) {
  const auto announced = announced_counts(bytes);
  if (!announced) return announced.error();
  // Draco needs about a bit per face even for the most regular mesh, so more than 64 faces per byte are a false count
  // that would only cause a large allocation.
  constexpr std::uint64_t max_per_byte = 64;
  const std::uint64_t plausible = max_per_byte * bytes.size();
  if (announced->faces > plausible || announced->points > plausible) {
    return Error{ErrorCode::malformed, "",
                 "declares " + std::to_string(announced->faces) + " faces and " + std::to_string(announced->points) +
                     " points, more than " + std::to_string(bytes.size()) + " bytes of Draco data can contain"};
  }
  if (announced->faces > limits.max_triangles || announced->points > limits.max_points) {
    return Error{ErrorCode::too_large, "",
                 "declares " + std::to_string(announced->faces) + " faces and " + std::to_string(announced->points) +
                     " points of Draco data, at most " + std::to_string(limits.max_triangles) + " and " +
                     std::to_string(limits.max_points) + " are allowed"};
  }
  std::unique_ptr<draco::Mesh> mesh;
  try {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) return Error{ErrorCode::malformed, "", "has Draco data that cannot be decoded"};
    mesh = std::move(decoded).value();
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::too_large, "", "has Draco data that needs more memory than is available"};
  } catch (const std::length_error&) {
    return Error{ErrorCode::malformed, "", "has Draco data that declares an impossible size"};
  }
  if (mesh == nullptr || mesh->num_faces() > limits.max_triangles || mesh->num_points() > limits.max_points) {
    return Error{ErrorCode::too_large, "", "has Draco data that decodes to more than the limit"};
  }
  for (draco::FaceIndex f(0); f < mesh->num_faces(); ++f) {
    for (const draco::PointIndex& point : mesh->face(f)) {
      if (point.value() >= mesh->num_points()) {
        return Error{ErrorCode::out_of_range, "",
                     "has Draco data whose face " + std::to_string(f.value()) + " refers to point " +
                         std::to_string(point.value()) + ", but there are " + std::to_string(mesh->num_points())};
      }
    }
  }
  return DracoMesh(std::move(mesh));
}

std::uint32_t DracoMesh::point_count() const { return mesh_->num_points(); }

std::uint32_t DracoMesh::triangle_count() const { return mesh_->num_faces(); }

std::vector<Triangle> DracoMesh::triangles() const {
  std::vector<Triangle> triangles;
  triangles.reserve(mesh_->num_faces());
  for (draco::FaceIndex f(0); f < mesh_->num_faces(); ++f) {
    const draco::Mesh::Face& face = mesh_->face(f);
    triangles.push_back({face[0].value(), face[1].value(), face[2].value()});
  }
  return triangles;
}

Result<const draco::PointAttribute*> DracoMesh::attribute(std::uint32_t unique_id, std::size_t components) const {
  const draco::PointAttribute* const attribute = mesh_->GetAttributeByUniqueId(unique_id);
  if (attribute == nullptr || attribute->buffer() == nullptr) {
    return Error{ErrorCode::missing, "",
                 "refers to Draco attribute " + std::to_string(unique_id) + ", which does not exist"};
  }
  if (attribute->num_components() != components) {
    return Error{ErrorCode::mismatch, "",
                 "refers to a Draco attribute of " + std::to_string(int{attribute->num_components()}) +
                     " components, but needs " + std::to_string(components)};
  }
  if (!is_readable(attribute->data_type())) {
    return Error{ErrorCode::unsupported, "", "refers to a Draco attribute of an unsupported type"};
  }
  if (!attribute->is_mapping_identity() && attribute->indices_map_size() < mesh_->num_points()) {
    return Error{ErrorCode::malformed, "", "has Draco data with points that have no value"};
  }
  return attribute;
}

template <class T>
Result<std::vector<T>> DracoMesh::values(const draco::PointAttribute& attribute) const {
  const auto components = static_cast<std::size_t>(attribute.num_components());
  const auto stride = static_cast<std::uint64_t>(attribute.byte_stride());
  const std::uint64_t element = components * static_cast<std::uint64_t>(draco::DataTypeLength(attribute.data_type()));
  const std::uint64_t available = attribute.buffer()->data_size();
  std::vector<T> values(components * mesh_->num_points());
  for (draco::PointIndex point(0); point < mesh_->num_points(); ++point) {
    const draco::AttributeValueIndex value = attribute.mapped_index(point);
    T* const out = values.data() + components * point.value();
    if (value.value() * stride + static_cast<std::uint64_t>(attribute.byte_offset()) + element > available ||
        !attribute.ConvertValue<T>(value, static_cast<std::int8_t>(components), out)) {
      return Error{ErrorCode::malformed, "", "has Draco data with points that have no value"};
    }
  }
  return values;
}

Result<std::vector<float>> DracoMesh::floats(std::uint32_t unique_id, std::size_t components, bool normalized) const {
  const auto found = attribute(unique_id, components);
  if (!found) return found.error();
  auto values = this->values<float>(**found);
  if (!values) return values.error();
  const float scale =
      normalized && !(*found)->normalized() ? static_cast<float>(largest_of((*found)->data_type())) : 1.0F;
  for (float& value : *values) {
    if (!std::isfinite(value)) {
      return Error{ErrorCode::not_finite, "", "has Draco data with a number that is not finite"};
    }
    if (scale != 1.0F) value = std::max(value / scale, -1.0F);
  }
  return values;
}

template <class Vector>
Result<std::vector<Vector>> DracoMesh::vectors(std::uint32_t unique_id) const {
  constexpr auto components = static_cast<std::size_t>(Vector::length());
  static_assert(sizeof(Vector) == components * sizeof(float));
  const auto numbers = floats(unique_id, components);
  if (!numbers) return numbers.error();
  std::vector<Vector> vectors(mesh_->num_points());
  if (!vectors.empty()) std::memcpy(vectors.data(), numbers->data(), numbers->size() * sizeof(float));
  return vectors;
}

Result<std::vector<glm::vec3>> DracoMesh::vectors3(std::uint32_t unique_id) const {
  return vectors<glm::vec3>(unique_id);
}

Result<std::vector<glm::vec2>> DracoMesh::vectors2(std::uint32_t unique_id) const {
  return vectors<glm::vec2>(unique_id);
}

Result<std::vector<std::uint8_t>> DracoMesh::bytes(std::uint32_t unique_id, std::size_t components) const {
  const auto found = attribute(unique_id, components);
  if (!found) return found.error();
  return values<std::uint8_t>(**found);
}

Result<std::vector<Color8>> DracoMesh::colors(std::uint32_t unique_id) const {
  const auto found = attribute(unique_id, 3);
  if (!found) return found.error();
  if ((*found)->data_type() != draco::DT_UINT8) {
    return Error{ErrorCode::mismatch, "", "refers to a Draco attribute for colours that has no bytes"};
  }
  const auto bytes = values<std::uint8_t>(**found);
  if (!bytes) return bytes.error();
  std::vector<Color8> colors(mesh_->num_points());
  if (!colors.empty()) std::memcpy(colors.data(), bytes->data(), bytes->size());
  return colors;
}

Result<std::vector<std::uint32_t>> DracoMesh::numbers(std::uint32_t unique_id) const {
  const auto found = attribute(unique_id, 1);
  if (!found) return found.error();
  return values<std::uint32_t>(**found);
}

}  // namespace semblante

#include "clients/native/client/draco_decode.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <stdexcept>

#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>

#include "protocol/cpp/weights_format.h"

namespace semblante::client {
namespace {

Error refused(ErrorCode code, const char* message) { return {code, "mesh.drc", message}; }

/// #points by N numbers of an attribute; empty when it is not there or has another shape.
template <class T, int N, class Vector>
std::vector<Vector> read(const draco::Mesh& mesh, std::optional<std::uint32_t> id) {
  const draco::PointAttribute* attribute = id ? mesh.GetAttributeByUniqueId(*id) : nullptr;
  if (attribute == nullptr || attribute->num_components() != N) {
    return {};
  }
  std::vector<Vector> values(mesh.num_points());
  for (std::uint32_t p = 0; p < mesh.num_points(); ++p) {
    const draco::AttributeValueIndex index = attribute->mapped_index(draco::PointIndex(p));
    if (index.value() >= attribute->size()) {
      return {};
    }
    T numbers[N];
    if (!attribute->ConvertValue<T, N>(index, numbers)) {
      return {};
    }
    if constexpr (N == 3) {
      values[p] = Vector(numbers[0], numbers[1], numbers[2]);
    } else if constexpr (N == 2) {
      values[p] = Vector(numbers[0], numbers[1]);
    } else {
      values[p] = numbers[0];
    }
  }
  return values;
}

/// Draco allocates by the counts its bytes begin with, so those are read first (bitstream 2.x: magic, version, mesh,
/// method, flags, then for edgebreaker a traversal byte; vertices and faces as varints, the other way round when the
/// method is sequential).
Status check_announced(std::span<const std::uint8_t> bytes, const RigDocument::Mesh& mesh) {
  constexpr std::size_t header_size = 11;
  constexpr std::uint8_t mesh_type = 1;
  constexpr std::uint8_t edgebreaker = 1;
  constexpr std::uint8_t metadata_flag = 0x80;
  if (bytes.size() < header_size + 1 || !std::equal(bytes.begin(), bytes.begin() + 5, "DRACO")) {
    return refused(ErrorCode::malformed, "not a Draco file");
  }
  if (bytes[5] != 2 || bytes[7] != mesh_type || bytes[8] > edgebreaker || (bytes[10] & metadata_flag) != 0) {
    return refused(ErrorCode::unsupported, "not a mesh of Draco's bitstream 2 without metadata");
  }
  std::size_t at = header_size + (bytes[8] == edgebreaker ? 1 : 0);
  const auto varint = [&]() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 35 && at < bytes.size(); shift += 7) {
      const std::uint8_t byte = bytes[at++];
      value |= std::uint64_t{byte & 0x7FU} << shift;
      if (byte < 0x80) {
        return value;
      }
    }
    return ~std::uint64_t{0};
  };
  const std::uint64_t first = varint();
  const std::uint64_t second = varint();
  const std::uint64_t vertices = bytes[8] == edgebreaker ? first : second;
  const std::uint64_t faces = bytes[8] == edgebreaker ? second : first;
  // Edgebreaker counts vertices before seams split them into points.
  if (faces != mesh.triangles || vertices > mesh.vertices) {
    return refused(ErrorCode::mismatch, "another number of vertices or triangles than rig.json says");
  }
  return Unit{};
}

Result<DecodedMesh> decode(std::span<const std::uint8_t> bytes, const RigDocument::Mesh& announced) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Decoder decoder;
  auto outcome = decoder.DecodeMeshFromBuffer(&buffer);
  if (!outcome.ok()) {
    return Error{ErrorCode::malformed, "mesh.drc", "not a Draco mesh: " + outcome.status().error_msg_string()};
  }
  const std::unique_ptr<draco::Mesh> mesh = std::move(outcome).value();
  if (mesh->num_points() != announced.vertices || mesh->num_faces() != announced.triangles) {
    return refused(ErrorCode::mismatch, "another number of vertices or triangles than rig.json says");
  }
  DecodedMesh decoded;
  decoded.positions = read<float, 3, glm::vec3>(*mesh, announced.attributes.position);
  decoded.uvs = read<float, 2, glm::vec2>(*mesh, announced.attributes.uv);
  decoded.materials = read<std::uint8_t, 1, std::uint8_t>(*mesh, announced.attributes.material);
  if (decoded.positions.empty()) {
    return refused(ErrorCode::missing, "no positions under the number that rig.json gives");
  }
  for (const glm::vec3& p : decoded.positions) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      return refused(ErrorCode::not_finite, "a position is not a finite number");
    }
  }
  decoded.triangles.resize(mesh->num_faces());
  for (std::uint32_t f = 0; f < mesh->num_faces(); ++f) {
    const draco::Mesh::Face& face = mesh->face(draco::FaceIndex(f));
    for (std::size_t corner = 0; corner < 3; ++corner) {
      decoded.triangles[f][corner] = face[static_cast<int>(corner)].value();
      if (decoded.triangles[f][corner] >= decoded.positions.size()) {
        return refused(ErrorCode::out_of_range, "a triangle names a vertex that is not there");
      }
    }
  }
  return decoded;
}

}  // namespace

Result<DecodedMesh> decode_mesh(std::span<const std::uint8_t> bytes, const RigDocument::Mesh& mesh) {
  if (mesh.vertices == 0 || mesh.triangles == 0) {
    return refused(ErrorCode::empty, "rig.json announces no vertices or no triangles");
  }
  if (mesh.vertices > max_weights_vertices || mesh.triangles > 2U * max_weights_vertices) {
    return refused(ErrorCode::too_large, "more than 4 million vertices or 8 million triangles");
  }
  if (auto fine = check_announced(bytes, mesh); !fine) {
    return std::move(fine).error();
  }
  // What is announced further inside may still be too much.
  try {
    return decode(bytes, mesh);
  } catch (const std::bad_alloc&) {
    return refused(ErrorCode::too_large, "the mesh asks for more memory than there is");
  } catch (const std::length_error&) {
    return refused(ErrorCode::too_large, "the mesh asks for more memory than there is");
  }
}

}  // namespace semblante::client

#include "protocol/package/mesh_encoding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/draco/draco_encode.h"
#include "core/draco/draco_mesh.h"
#include "protocol/package/quantization.h"

namespace semblante {
namespace {

/// The smallest result, still 0.1 s for 27k vertices; the speed of decoding hardly depends on it.
constexpr int encoding_speed = 0;

/// Triangles as file vertices, each rotated so that its least number is first: comparable across renumberings.
std::vector<Triangle> canonical(std::span<const Triangle> triangles, std::span<const std::uint32_t> file_vertex) {
  std::vector<Triangle> out;
  out.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    Triangle named = {file_vertex[t[0]], file_vertex[t[1]], file_vertex[t[2]]};
    if (named[0] == named[1] || named[1] == named[2] || named[2] == named[0])
      continue;  // not possible in an edge graph
    std::rotate(named.begin(), std::min_element(named.begin(), named.end()), named.end());
    out.push_back(named);
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// A mesh as a client decodes it.
struct Decoded {
  std::vector<Triangle> triangles;
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> file_vertex;  ///< empty if the bytes have no vertex numbers
};

/// `positions` and `file_vertex` are Draco unique ids.
Result<Decoded> decode(std::span<const std::uint8_t> bytes, std::uint32_t positions,
                       std::optional<std::uint32_t> file_vertex) {
  const auto draco = DracoMesh::decode(bytes);
  if (!draco) return draco.error();
  Decoded out;
  out.triangles = draco->triangles();
  auto read = draco->vectors3(positions);
  if (!read) return read.error();
  out.positions = std::move(*read);
  if (!file_vertex) return out;
  auto numbers = draco->numbers(*file_vertex);
  if (!numbers) return numbers.error();
  out.file_vertex = std::move(*numbers);
  return out;
}

Status check_decoded(const RenderMesh& mesh, const Decoded& decoded, std::span<const glm::vec3> file_positions) {
  for (const std::uint32_t number : decoded.file_vertex) {
    if (number >= file_positions.size())
      return Error{ErrorCode::internal, "mesh.drc", "a vertex number came back wrong"};
  }
  if (canonical(decoded.triangles, decoded.file_vertex) != canonical(mesh.triangles, mesh.file_vertex)) {
    return Error{ErrorCode::internal, "mesh.drc", "triangles were lost or changed by the encoding"};
  }
  const auto [low, high] = bounds_of(mesh);
  // Draco divides the longest side of the box into 2^bits - 1 steps; rounding errs by half a step, float32 by a little.
  const float reach = std::max(
      {std::abs(low.x), std::abs(low.y), std::abs(low.z), std::abs(high.x), std::abs(high.y), std::abs(high.z)});
  const float tolerance =
      0.51F * longest_side(low, high) / static_cast<float>((1 << mesh.position_bits) - 1) + 4e-7F * reach;
  for (std::size_t v = 0; v < decoded.positions.size(); ++v) {
    const glm::vec3& original = file_positions[decoded.file_vertex[v]];
    for (int c = 0; c < 3; ++c) {
      if (!(std::abs(decoded.positions[v][c] - original[c]) <= tolerance)) {
        return Error{ErrorCode::internal, "mesh.drc", "a position moved by more than a quantum"};
      }
    }
  }
  return Unit{};
}

}  // namespace

Result<EncodedMesh> encode_mesh(const RenderMesh& mesh) {
  if (mesh.triangles.empty()) return Error{ErrorCode::empty, "mesh.drc", "the model has no triangles"};
  // One value per file vertex: shared by the render vertices of a seam, so that Draco sees one surface.
  const std::uint32_t file_count = *std::max_element(mesh.file_vertex.begin(), mesh.file_vertex.end()) + 1;
  std::vector<std::uint32_t> value_of_file(file_count, Model::no_index);
  std::vector<std::uint32_t> numbers;
  std::vector<glm::vec3> positions;
  std::vector<Color8> colors;
  std::vector<std::uint32_t> value_of_point;
  std::vector<glm::vec3> file_positions(file_count);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    std::uint32_t& value = value_of_file[mesh.file_vertex[v]];
    if (value == Model::no_index) {
      value = static_cast<std::uint32_t>(positions.size());
      positions.push_back(mesh.positions[v]);
      if (!mesh.colors.empty()) colors.push_back(mesh.colors[v]);
      numbers.push_back(mesh.file_vertex[v]);
      file_positions[mesh.file_vertex[v]] = mesh.positions[v];
    }
    value_of_point.push_back(value);
  }

  using Kind = DracoAttribute::Kind;
  using Type = DracoAttribute::Type;
  EncodedMesh out;
  std::vector<DracoAttribute> attributes;
  attributes.push_back(
      {Kind::position, Type::float32, 3, std::as_bytes(std::span(positions)), value_of_point, mesh.position_bits});
  attributes.push_back({Kind::normal, Type::float32, 3, std::as_bytes(std::span(mesh.normals)), {}, normal_bits});
  if (!mesh.uvs.empty()) {
    out.attributes.uv = static_cast<std::uint32_t>(attributes.size());
    attributes.push_back({Kind::uv, Type::float32, 2, std::as_bytes(std::span(mesh.uvs)), {}, uv_bits});
  }
  out.attributes.material = static_cast<std::uint32_t>(attributes.size());
  attributes.push_back({Kind::generic, Type::uint8, 1, std::as_bytes(std::span(mesh.materials)), {}, 0});
  if (!colors.empty()) {
    out.attributes.color = static_cast<std::uint32_t>(attributes.size());
    attributes.push_back({Kind::color, Type::uint8, 3, std::as_bytes(std::span(colors)), value_of_point, 0});
  }
  auto bytes = encode_draco(mesh.positions.size(), mesh.triangles, attributes, encoding_speed);
  if (!bytes) return bytes.error();
  const auto shipped = decode(*bytes, out.attributes.position, std::nullopt);
  if (!shipped) return shipped.error();

  const auto vertex_numbers = static_cast<std::uint32_t>(attributes.size());
  attributes.push_back({Kind::generic, Type::uint32, 1, std::as_bytes(std::span(numbers)), value_of_point, 0});
  const auto trial = encode_draco(mesh.positions.size(), mesh.triangles, attributes, encoding_speed);
  if (!trial) return trial.error();
  auto decoded = decode(*trial, out.attributes.position, vertex_numbers);
  if (!decoded) return decoded.error();
  if (shipped->triangles != decoded->triangles || shipped->positions != decoded->positions) {
    return Error{ErrorCode::internal, "mesh.drc", "the vertex numbers changed the order of the mesh"};
  }
  const Status same = check_decoded(mesh, *decoded, file_positions);
  if (!same) return same.error();

  out.bytes = std::move(*bytes);
  out.file_vertex = std::move(decoded->file_vertex);
  out.triangle_count = decoded->triangles.size();
  return out;
}

}  // namespace semblante

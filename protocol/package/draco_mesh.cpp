#include "protocol/package/draco_mesh.h"

#include <cassert>
#include <cstring>
#include <memory>

#include <draco/compression/decode.h>
#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>

namespace semblante {
namespace {

draco::GeometryAttribute::Type draco_kind(DracoAttribute::Kind kind) {
  switch (kind) {
    case DracoAttribute::Kind::position:
      return draco::GeometryAttribute::POSITION;
    case DracoAttribute::Kind::normal:
      return draco::GeometryAttribute::NORMAL;
    case DracoAttribute::Kind::uv:
      return draco::GeometryAttribute::TEX_COORD;
    case DracoAttribute::Kind::generic:
      break;
  }
  return draco::GeometryAttribute::GENERIC;
}

struct NumberType {
  draco::DataType type;
  std::size_t size;
};

NumberType number_type(DracoAttribute::Type type) {
  switch (type) {
    case DracoAttribute::Type::uint8:
      return {draco::DT_UINT8, 1};
    case DracoAttribute::Type::uint16:
      return {draco::DT_UINT16, 2};
    case DracoAttribute::Type::uint32:
      return {draco::DT_UINT32, 4};
    case DracoAttribute::Type::float32:
      break;
  }
  return {draco::DT_FLOAT32, 4};
}

void add_attribute(draco::Mesh& mesh, const DracoAttribute& attribute) {
  const auto [type, size] = number_type(attribute.type);
  const std::size_t stride = size * static_cast<std::size_t>(attribute.components);
  const std::size_t value_count = attribute.values.size() / stride;
  draco::GeometryAttribute layout;
  layout.Init(draco_kind(attribute.kind), nullptr, static_cast<std::int8_t>(attribute.components), type, false,
              static_cast<std::int64_t>(stride), 0);
  const bool identity = attribute.value_of_point.empty();
  const int id = mesh.AddAttribute(layout, identity, static_cast<std::uint32_t>(value_count));
  draco::PointAttribute& values = *mesh.attribute(id);
  for (std::size_t v = 0; v < value_count; ++v) {
    values.SetAttributeValue(draco::AttributeValueIndex(static_cast<std::uint32_t>(v)),
                             attribute.values.data() + v * stride);
  }
  for (std::size_t p = 0; p < attribute.value_of_point.size(); ++p) {
    values.SetPointMapEntry(draco::PointIndex(static_cast<std::uint32_t>(p)),
                            draco::AttributeValueIndex(attribute.value_of_point[p]));
  }
}

/// The values of `attribute` (may be null: it did not come back) by point.
template <class T>
Status read_values(const draco::Mesh& mesh, const draco::PointAttribute* attribute, std::int8_t components,
                   const char* name, std::vector<T>& out) {
  if (attribute == nullptr)
    return Error{ErrorCode::missing, "mesh.drc", "the " + std::string(name) + " did not come back"};
  out.resize(std::size_t{mesh.num_points()} * static_cast<std::size_t>(components));
  for (std::uint32_t p = 0; p < mesh.num_points(); ++p) {
    if (!attribute->ConvertValue<T>(attribute->mapped_index(draco::PointIndex(p)), components,
                                    &out[std::size_t{p} * static_cast<std::size_t>(components)])) {
      return Error{ErrorCode::malformed, "mesh.drc", "the " + std::string(name) + " are of another type"};
    }
  }
  return Unit{};
}

}  // namespace

Result<std::vector<std::uint8_t>> encode_draco(std::size_t point_count, std::span<const Triangle> triangles,
                                               std::span<const DracoAttribute> attributes, int speed) {
  draco::Mesh mesh;
  mesh.set_num_points(static_cast<std::uint32_t>(point_count));
  mesh.SetNumFaces(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    draco::Mesh::Face face;
    for (std::size_t c = 0; c < 3; ++c) {
      assert(triangles[t][c] < point_count);
      face[c] = draco::PointIndex(triangles[t][c]);
    }
    mesh.SetFace(draco::FaceIndex(static_cast<std::uint32_t>(t)), face);
  }
  for (const DracoAttribute& attribute : attributes) add_attribute(mesh, attribute);

  draco::ExpertEncoder encoder(mesh);
  encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
  encoder.SetSpeedOptions(speed, speed);
  for (std::size_t a = 0; a < attributes.size(); ++a) {
    if (attributes[a].quantization_bits > 0) {
      encoder.SetAttributeQuantization(static_cast<int>(a), attributes[a].quantization_bits);
    }
  }
  draco::EncoderBuffer buffer;
  const draco::Status status = encoder.EncodeToBuffer(&buffer);
  if (!status.ok()) return Error{ErrorCode::internal, "mesh.drc", std::string("Draco: ") + status.error_msg()};
  const auto* const begin = reinterpret_cast<const std::uint8_t*>(buffer.data());
  return std::vector<std::uint8_t>(begin, begin + buffer.size());
}

Result<DecodedMesh> decode_draco(std::span<const std::uint8_t> bytes, const DecodedAttributes& wanted) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) return Error{ErrorCode::malformed, "mesh.drc", decoded.status().error_msg_string()};
  const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();

  DecodedMesh out;
  out.point_count = mesh->num_points();
  const auto* const positions = mesh->GetNamedAttribute(draco::GeometryAttribute::POSITION);
  if (const Status read = read_values(*mesh, positions, 3, "positions", out.positions); !read) return read.error();
  const auto read_wanted = [&](const std::optional<std::uint32_t>& id, std::int8_t components, const char* name,
                               auto& to) -> Status {
    if (!id) return Unit{};
    return read_values(*mesh, mesh->GetAttributeByUniqueId(*id), components, name, to);
  };
  for (const Status& read : {read_wanted(wanted.normal, 3, "normals", out.normals),
                             read_wanted(wanted.uv, 2, "texture coordinates", out.uvs),
                             read_wanted(wanted.material, 1, "materials", out.materials),
                             read_wanted(wanted.file_vertex, 1, "vertex numbers", out.file_vertex)}) {
    if (!read) return read.error();
  }
  out.triangles.reserve(mesh->num_faces());
  for (std::uint32_t f = 0; f < mesh->num_faces(); ++f) {
    const draco::Mesh::Face& face = mesh->face(draco::FaceIndex(f));
    out.triangles.push_back({face[0].value(), face[1].value(), face[2].value()});
    for (const std::uint32_t corner : out.triangles.back()) {
      if (corner >= out.point_count) return Error{ErrorCode::malformed, "mesh.drc", "a corner is no vertex"};
    }
  }
  return out;
}

}  // namespace semblante

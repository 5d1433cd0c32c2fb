#include "core/draco/draco_encode.h"

#include <cassert>
#include <string>

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
    case DracoAttribute::Kind::color:
      return draco::GeometryAttribute::COLOR;
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
  if (!status.ok()) return Error{ErrorCode::internal, "Draco", status.error_msg()};
  const auto* const begin = reinterpret_cast<const std::uint8_t*>(buffer.data());
  return std::vector<std::uint8_t>(begin, begin + buffer.size());
}

}  // namespace semblante

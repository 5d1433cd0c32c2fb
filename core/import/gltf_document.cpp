#include "core/import/gltf_document.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "core/import/gltf_meshopt.h"

namespace semblante::import {
namespace {

enum ComponentType : std::uint64_t { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

std::size_t size_of_component(std::uint64_t type) {
  switch (type) {
    case i8:
    case u8:
      return 1;
    case i16:
    case u16:
      return 2;
    case u32:
    case f32:
      return 4;
    default:
      return 0;
  }
}

std::size_t components_of(std::string_view type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  if (type == "VEC4" || type == "MAT2") return 4;
  if (type == "MAT3") return 9;
  if (type == "MAT4") return 16;
  return 0;
}

template <class T>
T load(const std::uint8_t* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

/// One component as a float; signed normalized values are clamped at -1, as in glTF.
float to_float(const std::uint8_t* from, std::uint64_t type, bool normalized) {
  switch (type) {
    case i8:
      return normalized ? std::max(load<std::int8_t>(from) / 127.0F, -1.0F) : load<std::int8_t>(from);
    case u8:
      return normalized ? load<std::uint8_t>(from) / 255.0F : load<std::uint8_t>(from);
    case i16:
      return normalized ? std::max(load<std::int16_t>(from) / 32767.0F, -1.0F) : load<std::int16_t>(from);
    case u16:
      return normalized ? load<std::uint16_t>(from) / 65535.0F : load<std::uint16_t>(from);
    case u32:
      return static_cast<float>(load<std::uint32_t>(from));
    default:
      return load<float>(from);
  }
}

std::uint32_t to_index(const std::uint8_t* from, std::uint64_t type) {
  if (type == u8) return load<std::uint8_t>(from);
  if (type == u16) return load<std::uint16_t>(from);
  return load<std::uint32_t>(from);
}

bool is_index_type(std::uint64_t type) { return type == u8 || type == u16 || type == u32; }

}  // namespace

Result<std::vector<std::uint8_t>> GltfDocument::resource(const std::string& uri) {
  const bool is_data = uri.starts_with("data:");
  if (!is_data && !resources_) {
    return Error{ErrorCode::unsupported, "", "refers to " + shown(uri) + ", which is another file",
                 Advice::send_all_files};
  }
  const std::size_t left = limits_.max_file_bytes - std::min(resource_bytes_, limits_.max_file_bytes);
  auto bytes = is_data ? decode_data_uri(uri, left) : resources_(uri, left);
  if (bytes) resource_bytes_ += bytes->size();
  return bytes;
}

std::span<const std::uint8_t> GltfDocument::buffer(std::size_t index) {
  const JsonCursor where = item("buffers", index);
  if (failed()) return {};
  if (loaded_.empty()) loaded_.resize(count("buffers"));
  std::span<const std::uint8_t> bytes;
  if (!where.has("uri")) {
    if (index != 0) {
      where.fail(ErrorCode::missing, "has no uri, but only buffer 0 can be the binary chunk");
      return {};
    }
    bytes = binary_;
  } else {
    if (!loaded_[index]) {
      auto loaded = resource(where.member("uri").text());
      if (!loaded) {
        where.member("uri").fail(loaded.error());
        return {};
      }
      loaded_[index] = std::move(*loaded);
    }
    bytes = *loaded_[index];
  }
  const std::uint64_t announced = where.member("byteLength").integer();
  if (failed()) return {};
  if (announced > bytes.size()) {
    where.member("byteLength")
        .fail(ErrorCode::truncated,
              "is " + std::to_string(announced) + ", but the buffer has " + std::to_string(bytes.size()) + " bytes");
    return {};
  }
  return bytes.first(announced);
}

std::span<const std::uint8_t> GltfDocument::slice(const JsonCursor& where) {
  const std::size_t buffer_index = where.required_index("buffer", count("buffers"));
  const std::uint64_t offset = where.integer_or("byteOffset", 0);
  const std::uint64_t length = where.member("byteLength").integer();
  if (failed()) return {};
  const auto bytes = buffer(buffer_index);
  if (failed()) return {};
  if (offset > bytes.size() || length > bytes.size() - offset) {
    where.fail(ErrorCode::out_of_range, "spans bytes " + std::to_string(offset) + " to " +
                                            std::to_string(offset + length) + " of a buffer of " +
                                            std::to_string(bytes.size()) + " bytes");
    return {};
  }
  return bytes.subspan(offset, length);
}

std::span<const std::uint8_t> GltfDocument::view(std::size_t index) {
  const JsonCursor where = item("bufferViews", index);
  if (failed()) return {};
  constexpr const char* meshopt = "EXT_meshopt_compression";
  if (!where.has("extensions") || !where.member("extensions").has(meshopt)) return slice(where);
  const JsonCursor compressed = where.member("extensions").member(meshopt);
  if (decoded_views_.empty()) decoded_views_.resize(count("bufferViews"));
  if (!decoded_views_[index]) {
    const MeshoptLayout layout = read_meshopt_layout(compressed);
    if (where.integer_or("byteStride", layout.stride) != layout.stride)
      compressed.member("byteStride").fail(ErrorCode::mismatch, "must be equal to the byteStride of its buffer view");
    const auto bytes = slice(compressed);
    if (failed()) return {};
    auto decoded =
        decode_meshopt(bytes, layout, limits_.max_file_bytes - std::min(resource_bytes_, limits_.max_file_bytes));
    if (!decoded) {
      compressed.fail(decoded.error().code, decoded.error().message);
      return {};
    }
    resource_bytes_ += decoded->size();
    decoded_views_[index] = std::move(*decoded);
  }
  const std::span<const std::uint8_t> bytes = *decoded_views_[index];
  if (const std::uint64_t length = where.member("byteLength").integer(); !failed() && length > bytes.size()) {
    where.member("byteLength")
        .fail(ErrorCode::out_of_range, "is " + std::to_string(length) + ", but its meshopt data decodes to " +
                                           std::to_string(bytes.size()) + " bytes");
  }
  return failed() ? std::span<const std::uint8_t>{} : bytes;
}

std::span<const std::uint8_t> GltfDocument::draco_view(std::size_t index, const JsonCursor& where) {
  constexpr std::size_t max_times = 8;
  const auto bytes = view(index);
  draco_bytes_ += bytes.size();
  if (draco_bytes_ <= max_times * (binary_.size() + resource_bytes_)) return bytes;
  where.fail(ErrorCode::too_large, "repeats Draco data: all references together exceed " + std::to_string(max_times) +
                                       " times the size of the file");
  return {};
}

GltfDocument::Layout GltfDocument::layout(const JsonCursor& where, std::size_t count, std::size_t element_size) {
  const std::size_t view_index = where.required_index("bufferView", this->count("bufferViews"));
  const std::uint64_t offset = where.integer_or("byteOffset", 0);
  if (failed()) return {};
  const auto bytes = view(view_index);
  const std::uint64_t stride = item("bufferViews", view_index).integer_or("byteStride", element_size);
  if (failed()) return {};
  constexpr std::uint64_t max_stride = 65536;
  if (stride < element_size || stride > max_stride) {
    item("bufferViews", view_index)
        .member("byteStride")
        .fail(ErrorCode::out_of_range,
              "is " + std::to_string(stride) + ", but elements have " + std::to_string(element_size) + " bytes");
    return {};
  }
  // count, stride and offset are all far below 2^63 here: no overflow.
  const std::uint64_t needed = count == 0 ? 0 : offset + (count - 1) * stride + element_size;
  if (needed > bytes.size()) {
    where.fail(ErrorCode::out_of_range,
               "needs " + std::to_string(needed) + " bytes, but its buffer view has " + std::to_string(bytes.size()));
    return {};
  }
  return {count == 0 ? std::span<const std::uint8_t>{} : bytes.subspan(offset), stride};
}

std::size_t GltfDocument::accessor_count(std::size_t accessor, std::size_t max) {
  const JsonCursor where = item("accessors", accessor).member("count");
  const std::uint64_t announced = where.integer(0, ~std::uint64_t{0});
  if (announced > max) {
    where.fail(ErrorCode::too_large,
               "is " + std::to_string(announced) + ", at most " + std::to_string(max) + " are allowed");
  }
  return failed() ? 0 : static_cast<std::size_t>(announced);
}

template <class Put>
void GltfDocument::for_each_sparse(const JsonCursor& accessor, std::size_t count, std::size_t element_size, Put put) {
  const JsonCursor sparse = accessor.member("sparse");
  const std::uint64_t replaced = sparse.member("count").integer(0, count);
  const JsonCursor index_place = sparse.member("indices");
  const std::uint64_t type = index_place.member("componentType").integer();
  if (failed()) return;
  if (!is_index_type(type)) {
    index_place.member("componentType").fail(ErrorCode::malformed, "must be an unsigned type");
    return;
  }
  const Layout indices = layout(index_place, replaced, size_of_component(type));
  const Layout values = layout(sparse.member("values"), replaced, element_size);
  if (failed()) return;
  for (std::size_t i = 0; i < replaced; ++i) {
    const std::uint32_t index = to_index(indices.bytes.data() + i * indices.stride, type);
    if (index >= count) {
      index_place.fail(ErrorCode::out_of_range, "has index " + std::to_string(index) + ", but the accessor has " +
                                                    std::to_string(count) + " elements");
      return;
    }
    put(index, values.bytes.data() + i * values.stride);
  }
}

GltfDocument::Elements GltfDocument::elements(const JsonCursor& where, std::size_t components, std::size_t count) {
  Elements elements;
  elements.type = where.member("componentType").integer();
  elements.normalized = where.boolean_or("normalized", false);
  elements.components = components;
  const std::size_t component_size = size_of_component(elements.type);
  const std::string shape = where.member("type").text();
  const std::uint64_t announced = where.member("count").integer(0, ~std::uint64_t{0});
  if (failed()) return {};
  if (component_size == 0) where.member("componentType").fail(ErrorCode::malformed, "is not a component type");
  if (components_of(shape) != components) {
    where.member("type").fail(ErrorCode::malformed, "must have " + std::to_string(components) + " components");
  }
  if (announced > limits_.max_vertices) {
    where.member("count").fail(ErrorCode::too_large, "is " + std::to_string(announced) + ", at most " +
                                                         std::to_string(limits_.max_vertices) + " are allowed");
  }
  if (announced != count) {
    where.member("count").fail(ErrorCode::mismatch,
                               "is " + std::to_string(announced) + ", but must be " + std::to_string(count));
  }
  if (failed()) return {};
  elements.size = components * component_size;
  elements.has_view = where.has("bufferView");
  if (elements.has_view) elements.layout = layout(where, count, elements.size);
  return elements;
}

bool GltfDocument::read_row(const JsonCursor& where, const Elements& elements, std::size_t row,
                            const std::uint8_t* from, float* to, NotFinite not_finite) {
  const std::size_t component_size = elements.size / elements.components;
  for (std::size_t c = 0; c < elements.components; ++c) {
    to[c] = to_float(from + c * component_size, elements.type, elements.normalized);
    if (!std::isfinite(to[c])) {
      if (not_finite == NotFinite::zero) {
        std::fill_n(to, elements.components, 0.0F);
        return true;
      }
      where.fail(ErrorCode::not_finite, "element " + std::to_string(row) + " is not a finite number");
      return false;
    }
  }
  return true;
}

std::vector<float> GltfDocument::floats(std::size_t accessor, std::size_t components, std::size_t count,
                                        NotFinite not_finite) {
  const JsonCursor where = item("accessors", accessor);
  const Elements source = elements(where, components, count);
  if (failed()) return {};
  std::vector<float> values(count * components, 0.0F);
  for (std::size_t i = 0; source.has_view && i < count; ++i) {
    const std::uint8_t* const from = source.layout.bytes.data() + i * source.layout.stride;
    if (!read_row(where, source, i, from, values.data() + i * components, not_finite)) return {};
  }
  if (where.has("sparse")) {
    for_each_sparse(where, count, source.size, [&](std::size_t index, const std::uint8_t* from) {
      read_row(where, source, index, from, values.data() + index * components, not_finite);
    });
  }
  return failed() ? std::vector<float>{} : values;
}

std::vector<GltfDocument::Row> GltfDocument::rows(std::size_t accessor, std::size_t count, std::size_t& budget) {
  const JsonCursor where = item("accessors", accessor);
  const Elements source = elements(where, 3, count);
  if (failed()) return {};
  const std::uint64_t replaced = where.has("sparse") ? where.member("sparse").member("count").integer(0, count) : 0;
  const std::size_t cost = (source.has_view ? count : 0) + static_cast<std::size_t>(replaced) + 1;
  if (failed() || cost > budget) {
    budget = 0;
    return {};
  }
  budget -= cost;
  std::vector<Row> rows;
  for (std::size_t i = 0; source.has_view && i < count; ++i) {
    std::array<float, 3> value{};
    if (!read_row(where, source, i, source.layout.bytes.data() + i * source.layout.stride, value.data())) return {};
    if (value != std::array<float, 3>{}) rows.push_back({static_cast<std::uint32_t>(i), value});
  }
  if (where.has("sparse")) {
    const auto first = static_cast<std::ptrdiff_t>(rows.size());
    for_each_sparse(where, count, source.size, [&](std::size_t index, const std::uint8_t* from) {
      std::array<float, 3> value{};
      if (read_row(where, source, index, from, value.data()))
        rows.push_back({static_cast<std::uint32_t>(index), value});
    });
    // The standard requires sparse rows in rising order; other orders are accepted, and the last of equal indices is
    // used.
    const auto by_index = [](const Row& a, const Row& b) { return a.index < b.index; };
    std::stable_sort(rows.begin() + first, rows.end(), by_index);
    std::inplace_merge(rows.begin(), rows.begin() + first, rows.end(), by_index);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (i + 1 < rows.size() && rows[i + 1].index == rows[i].index) continue;
      if (rows[i].value != std::array<float, 3>{}) rows[kept++] = rows[i];
    }
    rows.resize(kept);
  }
  return failed() ? std::vector<Row>{} : rows;
}

std::vector<std::uint32_t> GltfDocument::indices(std::size_t accessor, std::size_t end, std::size_t max_count) {
  const JsonCursor where = item("accessors", accessor);
  const std::uint64_t type = where.member("componentType").integer();
  const std::string shape = where.member("type").text();
  const std::size_t count = accessor_count(accessor, max_count);
  if (failed()) return {};
  if (!is_index_type(type)) where.member("componentType").fail(ErrorCode::malformed, "must be an unsigned type");
  if (shape != "SCALAR") where.member("type").fail(ErrorCode::malformed, "must be SCALAR");
  if (failed()) return {};
  const std::size_t element_size = size_of_component(type);
  const bool has_view = where.has("bufferView");
  const Layout elements = has_view ? layout(where, count, element_size) : Layout{};
  if (failed()) return {};
  std::vector<std::uint32_t> values(count, 0);
  if (has_view) {
    for (std::size_t i = 0; i < count; ++i) values[i] = to_index(elements.bytes.data() + i * elements.stride, type);
  }
  if (where.has("sparse")) {
    for_each_sparse(where, count, element_size,
                    [&](std::size_t index, const std::uint8_t* from) { values[index] = to_index(from, type); });
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] >= end) {
      where.fail(ErrorCode::out_of_range, "element " + std::to_string(i) + " refers to vertex " +
                                              std::to_string(values[i]) + ", but there are " + std::to_string(end) +
                                              " vertices");
      return {};
    }
  }
  return failed() ? std::vector<std::uint32_t>{} : values;
}

}  // namespace semblante::import

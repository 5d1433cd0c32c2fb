#include "core/import/ply_reader.h"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/import/byte_reader.h"
#include "core/import/model_builder.h"
#include "core/import/ply_header.h"
#include "core/import/polygon.h"
#include "core/import/text.h"

namespace semblante::import {
namespace {

/// Sequential values of a text or of binary data. The first error is kept; later values are zero.
class ValueSource {
 public:
  ValueSource(std::span<const std::uint8_t> bytes, const PlyHeader& header)
      : is_text_(header.is_text),
        offset_(header.data_offset),
        data_(bytes.subspan(header.data_offset), header.order),
        lines_(as_text(bytes.subspan(header.data_offset))),
        header_lines_(header.line_count) {}

  double next(PlyType type) {
    if (fault_) return 0.0;
    return is_text_ ? next_of_text() : next_of_bytes(type);
  }

  /// A lower bound of the unread bytes; limits every declared count.
  [[nodiscard]] std::size_t left() const { return is_text_ ? line_.size() + 1 + lines_.rest().size() : data_.left(); }
  [[nodiscard]] const std::optional<Error>& fault() const { return fault_; }
  [[nodiscard]] std::string where() const {
    return is_text_ ? "line " + std::to_string(header_lines_ + lines_.line())
                    : "byte " + std::to_string(offset_ + data_.position());
  }

 private:
  double next_of_bytes(PlyType type) {
    const std::string place = data_.left() < size_of(type) ? where() : std::string();
    double value = 0.0;
    switch (type) {
      case PlyType::i8:
        value = data_.read<std::int8_t>();
        break;
      case PlyType::u8:
        value = data_.read<std::uint8_t>();
        break;
      case PlyType::i16:
        value = data_.read<std::int16_t>();
        break;
      case PlyType::u16:
        value = data_.read<std::uint16_t>();
        break;
      case PlyType::i32:
        value = data_.read<std::int32_t>();
        break;
      case PlyType::u32:
        value = data_.read<std::uint32_t>();
        break;
      case PlyType::f32:
        value = data_.read<float>();
        break;
      case PlyType::f64:
        value = data_.read<double>();
        break;
    }
    if (!data_.ok())
      fault_ = Error{ErrorCode::truncated, place, "the data ends before the last element that the header declares"};
    return value;
  }

  double next_of_text() {
    std::string_view token = next_token(line_);
    while (token.empty()) {
      const auto line = lines_.next();
      if (!line) {
        fault_ = Error{ErrorCode::truncated, where(), "the data ends before the last element that the header declares"};
        return 0.0;
      }
      line_ = *line;
      token = next_token(line_);
    }
    double value = 0.0;
    if (token.size() > 1 && token.front() == '+' && token[1] != '-') token.remove_prefix(1);
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
    if (error == std::errc::result_out_of_range) {
      // Underflow of a double gives zero; overflow is refused where the value is used.
      float small = 0.0F;
      value = parse_number(token, small) == NumberFault::none ? 0.0 : std::numeric_limits<double>::infinity();
    } else if (error != std::errc{} || end != token.data() + token.size()) {
      fault_ = Error{ErrorCode::malformed, where(), shown(token) + " is not a number"};
    }
    return value;
  }

  bool is_text_;
  std::size_t offset_;
  ByteReader data_;
  LineReader lines_;
  std::string_view line_;
  std::size_t header_lines_;
  std::optional<Error> fault_;
};

class PlyReader {
 public:
  PlyReader(std::span<const std::uint8_t> bytes, const PlyHeader& header, const ImportLimits& limits)
      : header_(header), source_(bytes, header), builder_(limits), limits_(limits) {}

  Result<Model> read() {
    for (const PlyElement& element : header_.elements) {
      const std::size_t least = element.least_bytes(header_.is_text);
      // The last value of a text may have no blank after it.
      if (element.count > 0 && (least == 0 || element.count > (source_.left() + 1) / least)) {
        return Error{ErrorCode::truncated, source_.where(),
                     "the header declares " + std::to_string(element.count) + " elements " + shown(element.name) +
                         ", but only " + std::to_string(source_.left()) + " bytes are left"};
      }
      Status status = Unit{};
      if (element.name == "vertex") {
        status = read_vertices(element);
      } else if (element.name == "face") {
        status = read_faces(element);
      } else {
        if (element.name == "tristrips") builder_.warn("triangle strips are not supported and are omitted");
        status = skip(element);
      }
      if (!status) return status.error();
      if (source_.fault()) return *source_.fault();
    }
    if (Status status = add_triangles(); !status) return status.error();
    return std::move(builder_).finish("ply");
  }

 private:
  static std::optional<std::array<std::size_t, 2>> find_uv(const PlyElement& element) {
    static constexpr std::array<std::array<std::string_view, 2>, 4> names = {
        {{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}}};
    for (const auto& [u, v] : names) {
      const auto first = element.find(u);
      const auto second = element.find(v);
      if (first && second) return std::array<std::size_t, 2>{*first, *second};
    }
    return std::nullopt;
  }

  Result<float> to_float(double value, std::string_view name) const {
    if (std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max())) return static_cast<float>(value);
    return Error{ErrorCode::not_finite, source_.where(), "property " + shown(name) + " is not a finite number"};
  }

  Status read_vertices(const PlyElement& element) {
    if (has_vertices_) return Error{ErrorCode::malformed, "", "the header has element 'vertex' twice"};
    has_vertices_ = true;
    if (element.count > limits_.max_vertices) {
      return Error{ErrorCode::too_large, "",
                   "the header declares " + std::to_string(element.count) + " vertices, at most " +
                       std::to_string(limits_.max_vertices) + " are allowed"};
    }
    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    // x y z, nx ny nz, u v: their indices among the properties.
    std::array<std::size_t, 8> places{};
    places.fill(none);
    static constexpr std::array<std::string_view, 6> names = {"x", "y", "z", "nx", "ny", "nz"};
    for (std::size_t i = 0; i < names.size(); ++i) places[i] = element.find(names[i]).value_or(none);
    if (const auto uv = find_uv(element)) {
      places[6] = (*uv)[0];
      places[7] = (*uv)[1];
    }
    for (std::size_t i = 0; i < 3; ++i) {
      if (places[i] == none) {
        return Error{ErrorCode::missing, "", "element 'vertex' has no property " + shown(names[i])};
      }
    }
    has_normals_ = places[3] != none && places[4] != none && places[5] != none;
    has_uvs_ = places[6] != none;
    if (element.find("red")) builder_.warn("vertex colours are omitted: the face has the colours of its materials");
    std::vector<double> values(element.properties.size());
    for (std::uint64_t i = 0; i < element.count && !source_.fault(); ++i) {
      if (Status status = read_properties(element, values); !status) return status;
      std::array<float, 8> wanted{};
      for (std::size_t k = 0; k < wanted.size(); ++k) {
        if (places[k] == none) continue;
        const auto value = to_float(values[places[k]], element.properties[places[k]].name);
        if (!value) return value.error();
        wanted[k] = *value;
      }
      builder_.model.positions.emplace_back(wanted[0], wanted[1], wanted[2]);
      if (has_normals_) builder_.model.normals.emplace_back(wanted[3], wanted[4], wanted[5]);
      if (has_uvs_) builder_.model.uvs.emplace_back(wanted[6], 1.0F - wanted[7]);
    }
    return Unit{};
  }

  /// Number of items of a list, checked against the unread bytes.
  Result<std::size_t> list_size(const PlyProperty& property) {
    const double announced = source_.next(*property.list_size);
    if (source_.fault()) return *source_.fault();
    const std::size_t item = header_.is_text ? 2 : size_of(property.type);
    const std::size_t most = (source_.left() + 1) / item;
    if (announced < 0 || announced != std::floor(announced) || announced > static_cast<double>(most)) {
      return Error{ErrorCode::out_of_range, source_.where(),
                   "list " + shown(property.name) + " has a number of items that is invalid or exceeds the data"};
    }
    return static_cast<std::size_t>(announced);
  }

  /// One element's scalars; its lists are skipped.
  Status read_properties(const PlyElement& element, std::vector<double>& values) {
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      if (!property.list_size) {
        values[p] = source_.next(property.type);
        continue;
      }
      const auto size = list_size(property);
      if (!size) return size.error();
      for (std::size_t i = 0; i < *size && !source_.fault(); ++i) source_.next(property.type);
    }
    return Unit{};
  }

  Status skip(const PlyElement& element) {
    std::vector<double> values(element.properties.size());
    for (std::uint64_t i = 0; i < element.count && !source_.fault(); ++i) {
      if (Status status = read_properties(element, values); !status) return status;
    }
    return Unit{};
  }

  Status read_faces(const PlyElement& element) {
    auto list = element.find("vertex_indices");
    if (!list) list = element.find("vertex_index");
    if (!list || !element.properties[*list].list_size) {
      return Error{ErrorCode::missing, "", "element 'face' has no list 'vertex_indices'"};
    }
    for (std::uint64_t face = 0; face < element.count && !source_.fault(); ++face) {
      for (std::size_t p = 0; p < element.properties.size() && !source_.fault(); ++p) {
        const PlyProperty& property = element.properties[p];
        std::size_t size = 1;
        if (property.list_size) {
          const auto announced = list_size(property);
          if (!announced) return announced.error();
          size = *announced;
        }
        if (p != *list) {
          for (std::size_t i = 0; i < size && !source_.fault(); ++i) source_.next(property.type);
          continue;
        }
        if (Status status = read_face(size, property.type); !status) return status;
      }
    }
    return Unit{};
  }

  Status read_face(std::size_t size, PlyType type) {
    const std::size_t first = corners_.size();
    const std::string where = source_.where();
    if (size >= 3 && size - 2 > limits_.max_triangles - triangles_) {
      return Error{ErrorCode::too_large, where, "more than " + std::to_string(limits_.max_triangles) + " triangles"};
    }
    for (std::size_t i = 0; i < size && !source_.fault(); ++i) {
      const double index = source_.next(type);
      if (!(index >= 0.0 && index < static_cast<double>(limits_.max_vertices)) || index != std::floor(index)) {
        return Error{ErrorCode::out_of_range, where,
                     "a face has a vertex index that is negative, not an integer or too large"};
      }
      corners_.push_back(static_cast<std::uint32_t>(index));
    }
    if (size < 3) {
      corners_.resize(first);
      ++short_faces_;
      return Unit{};
    }
    triangles_ += size - 2;
    polygons_.push_back(static_cast<std::uint32_t>(first));
    return Unit{};
  }

  /// Called after everything has been read: a file may have its faces before its vertices.
  Status add_triangles() {
    if (!has_vertices_) return Error{ErrorCode::missing, "", "the header has no element 'vertex'"};
    if (short_faces_ > 0) builder_.warn(std::to_string(short_faces_) + " faces with fewer than 3 corners were omitted");
    Triangulator triangulator;
    std::vector<glm::vec3> positions;
    for (std::size_t i = 0; i < polygons_.size(); ++i) {
      const std::size_t end = i + 1 < polygons_.size() ? polygons_[i + 1] : corners_.size();
      const auto corners = std::span(corners_).subspan(polygons_[i], end - polygons_[i]);
      positions.clear();
      for (const std::uint32_t vertex : corners) {
        if (vertex >= builder_.model.positions.size()) {
          return Error{ErrorCode::out_of_range, "face " + std::to_string(i),
                       "refers to vertex " + std::to_string(vertex) + ", but there are " +
                           std::to_string(builder_.model.positions.size())};
        }
        positions.push_back(builder_.model.positions[vertex]);
      }
      for (const auto& [a, b, c] : triangulator.split(positions)) {
        builder_.add_triangle(corner(corners[a]), corner(corners[b]), corner(corners[c]));
      }
    }
    return Unit{};
  }

  [[nodiscard]] Corner corner(std::uint32_t vertex) const {
    return {vertex, has_uvs_ ? vertex : Model::no_index, has_normals_ ? vertex : Model::no_index};
  }

  const PlyHeader& header_;
  ValueSource source_;
  ModelBuilder builder_;
  const ImportLimits& limits_;
  bool has_vertices_ = false, has_normals_ = false, has_uvs_ = false;
  std::vector<std::uint32_t> corners_;
  std::vector<std::uint32_t> polygons_;  ///< first corner of each
  std::size_t triangles_ = 0;
  std::size_t short_faces_ = 0;
};

}  // namespace

Result<Model> read_ply(std::span<const std::uint8_t> bytes, const ImportLimits& limits) {
  const auto header = parse_ply_header(bytes);
  if (!header) return header.error();
  return PlyReader(bytes, *header, limits).read();
}

}  // namespace semblante::import

#include "core/import/ply_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/import/model_builder.h"
#include "core/import/ply_header.h"
#include "core/import/ply_values.h"
#include "core/import/polygon.h"
#include "core/import/text.h"
#include "core/import/vertex_colors.h"

namespace semblante::import {
namespace {

class PlyReader {
 public:
  PlyReader(std::span<const std::uint8_t> bytes, const PlyHeader& header, const ImportLimits& limits)
      : header_(header), source_(bytes, header), builder_(limits), limits_(limits) {}

  Result<Model> read() {
    auto model = read_elements();
    if (!source_.misplaced()) return model;
    // Values that follow a missing one are read as others than they are: what is then found wrong is not the fault.
    const std::string fault =
        "an element ends before its line does: a value in or before it may be missing or too many";
    if (!model && model.error().code != ErrorCode::too_large)
      return Error{ErrorCode::malformed, *source_.misplaced(), fault};
    if (model) model->warnings.push_back(*source_.misplaced() + ": " + fault);
    return model;
  }

 private:
  Result<Model> read_elements() {
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
        status = read_lists(element, &PlyReader::read_face);
      } else if (element.name == "tristrips") {
        status = read_lists(element, &PlyReader::read_strips);
      } else {
        status = skip(element);
      }
      if (!status) return status.error();
      if (source_.fault()) return *source_.fault();
    }
    if (Status status = add_triangles(); !status) return status.error();
    return std::move(builder_).finish("ply");
  }

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

  /// The indices of red, green and blue among the properties.
  static std::optional<std::array<std::size_t, 3>> find_colors(const PlyElement& element) {
    static constexpr std::array<std::array<std::string_view, 3>, 3> names = {
        {{"red", "green", "blue"}, {"diffuse_red", "diffuse_green", "diffuse_blue"}, {"r", "g", "b"}}};
    for (const auto& [r, g, b] : names) {
      const auto red = element.find(r);
      const auto green = element.find(g);
      const auto blue = element.find(b);
      if (red && green && blue) return std::array<std::size_t, 3>{*red, *green, *blue};
    }
    return std::nullopt;
  }

  static ColorNumbers numbers_of(PlyType type) {
    switch (type) {
      case PlyType::i8:
      case PlyType::u8:
        return ColorNumbers::bytes;
      case PlyType::f32:
      case PlyType::f64:
        return ColorNumbers::reals;
      default:
        return ColorNumbers::integers;
    }
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
    const auto colors = find_colors(element);
    if (!colors && element.find("red")) builder_.warn("vertex colours are omitted: green or blue is missing");
    GivenColors given;
    std::vector<double> values(element.properties.size());
    for (std::uint64_t i = 0; i < element.count && !source_.fault(); ++i) {
      if (Status status = read_properties(element, values); !status) return status;
      std::array<float, 8> wanted{};
      bool has_whole_normal = true;
      for (std::size_t k = 0; k < wanted.size(); ++k) {
        if (places[k] == none) continue;
        const auto value = to_float(values[places[k]], element.properties[places[k]].name);
        const bool is_of_normal = k >= 3 && k < 6;
        if (!value && !is_of_normal) return value.error();
        // Scans have a normal that is no number where a point has no neighbours.
        wanted[k] = value ? *value : 0.0F;
        has_whole_normal = has_whole_normal && value;
      }
      builder_.model.positions.emplace_back(wanted[0], wanted[1], wanted[2]);
      if (has_normals_)
        builder_.model.normals.push_back(has_whole_normal ? glm::vec3(wanted[3], wanted[4], wanted[5])
                                                          : glm::vec3(0.0F));
      if (has_uvs_) builder_.model.uvs.emplace_back(wanted[6], 1.0F - wanted[7]);
      if (colors) given.emplace_back(values[(*colors)[0]], values[(*colors)[1]], values[(*colors)[2]]);
    }
    if (colors) add_colors(given, numbers_of(element.properties[(*colors)[0]].type));
    return Unit{};
  }

  void add_colors(const GivenColors& given, ColorNumbers numbers) {
    append_colors(given, full_light(given, numbers), ColorSpace::srgb, builder_.model.colors);
    const auto faulty = given.size() - static_cast<std::size_t>(std::count_if(given.begin(), given.end(), is_color));
    if (faulty > 0) builder_.warn(warning_of_faulty_colors(faulty));
  }

  /// One element's scalars; its lists are skipped.
  Status read_properties(const PlyElement& element, std::vector<double>& values) {
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      if (!property.list_size) {
        values[p] = source_.next(property.type);
        continue;
      }
      const auto size = source_.list_size(property);
      if (!size) return size.error();
      for (std::size_t i = 0; i < *size && !source_.fault(); ++i) source_.next(property.type);
    }
    source_.end_element();
    return Unit{};
  }

  Status skip(const PlyElement& element) {
    std::vector<double> values(element.properties.size());
    for (std::uint64_t i = 0; i < element.count && !source_.fault(); ++i) {
      if (Status status = read_properties(element, values); !status) return status;
    }
    return Unit{};
  }

  using ListReader = Status (PlyReader::*)(std::size_t size, PlyType type);

  /// Reads the list of vertex indices of each of these elements by `read`, and skips their other properties.
  Status read_lists(const PlyElement& element, ListReader read) {
    auto list = element.find("vertex_indices");
    if (!list) list = element.find("vertex_index");
    are_faces_colored_ = are_faces_colored_ || element.find("red");
    if (!list || !element.properties[*list].list_size) {
      return Error{ErrorCode::missing, "", "element " + shown(element.name) + " has no list 'vertex_indices'"};
    }
    for (std::uint64_t i = 0; i < element.count && !source_.fault(); ++i) {
      for (std::size_t p = 0; p < element.properties.size() && !source_.fault(); ++p) {
        const PlyProperty& property = element.properties[p];
        std::size_t size = 1;
        if (property.list_size) {
          const auto announced = source_.list_size(property);
          if (!announced) return announced.error();
          size = *announced;
        }
        if (p != *list) {
          for (std::size_t k = 0; k < size && !source_.fault(); ++k) source_.next(property.type);
          continue;
        }
        if (Status status = (this->*read)(size, property.type); !status) return status;
      }
      source_.end_element();
    }
    return Unit{};
  }

  Error too_many_triangles(std::string where) const {
    return Error{ErrorCode::too_large, std::move(where),
                 "more than " + std::to_string(limits_.max_triangles) + " triangles"};
  }

  /// Whether it can be the index of a vertex; their number may still be unknown.
  [[nodiscard]] bool is_index(double value) const {
    return value >= 0.0 && value < static_cast<double>(limits_.max_vertices) && value == std::floor(value);
  }

  Status read_face(std::size_t size, PlyType type) {
    const std::size_t first = corners_.size();
    const std::string where = source_.where();
    if (size >= 3 && size - 2 > limits_.max_triangles - triangles_) return too_many_triangles(where);
    for (std::size_t i = 0; i < size && !source_.fault(); ++i) {
      const double index = source_.next(type);
      if (!is_index(index)) {
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

  /// Strips of triangles in one list: -1 ends a strip. Each vertex after the second of its strip makes a triangle with
  /// the two before it; every second triangle has its first two corners exchanged, so that all face the same way. A
  /// triangle with a repeated vertex only joins two strips and is no fault of the file.
  Status read_strips(std::size_t size, PlyType type) {
    std::array<std::uint32_t, 2> before{};
    std::size_t length = 0;  // vertices of the strip so far
    for (std::size_t i = 0; i < size && !source_.fault(); ++i) {
      const double index = source_.next(type);
      if (index == -1.0) {
        length = 0;
        continue;
      }
      if (!is_index(index)) {
        return Error{ErrorCode::out_of_range, source_.where(),
                     "a triangle strip has an item that is neither -1 nor the index of a vertex"};
      }
      const auto vertex = static_cast<std::uint32_t>(index);
      last_of_strips_ = std::max(last_of_strips_, vertex);
      if (length >= 2 && before[0] != before[1] && before[1] != vertex && vertex != before[0]) {
        if (triangles_ == limits_.max_triangles) return too_many_triangles(source_.where());
        ++triangles_;
        polygons_.push_back(static_cast<std::uint32_t>(corners_.size()));
        const bool exchanged = length % 2 == 1;
        corners_.insert(corners_.end(), {before[exchanged ? 1 : 0], before[exchanged ? 0 : 1], vertex});
      }
      before = {before[1], vertex};
      ++length;
    }
    return Unit{};
  }

  /// Called after everything has been read: a file may have its faces before its vertices.
  Status add_triangles() {
    if (!has_vertices_) return Error{ErrorCode::missing, "", "the header has no element 'vertex'"};
    if (last_of_strips_ > 0 && last_of_strips_ >= builder_.model.positions.size()) {
      return Error{ErrorCode::out_of_range, "element 'tristrips'",
                   "refers to vertex " + std::to_string(last_of_strips_) + ", but there are " +
                       std::to_string(builder_.model.positions.size())};
    }
    if (short_faces_ > 0) builder_.warn(std::to_string(short_faces_) + " faces with fewer than 3 corners were omitted");
    if (are_faces_colored_ && builder_.model.colors.empty())
      builder_.warn("colours of faces are omitted: only those of vertices are read");
    builder_.begin_primitive("", -1, !builder_.model.colors.empty());
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
  PlyValues source_;
  ModelBuilder builder_;
  const ImportLimits& limits_;
  bool has_vertices_ = false, has_normals_ = false, has_uvs_ = false, are_faces_colored_ = false;
  std::vector<std::uint32_t> corners_;
  std::vector<std::uint32_t> polygons_;  ///< first corner of each
  std::size_t triangles_ = 0;
  std::uint32_t last_of_strips_ = 0;  ///< greatest vertex index in a strip; it may be in no triangle
  std::size_t short_faces_ = 0;
};

}  // namespace

Result<Model> read_ply(std::span<const std::uint8_t> bytes, const ImportLimits& limits) {
  const auto header = parse_ply_header(bytes);
  if (!header) return header.error();
  return PlyReader(bytes, *header, limits).read();
}

}  // namespace semblante::import

#include "core/import/stl_reader.h"

#include <cmath>
#include <unordered_map>

#include "core/import/byte_reader.h"
#include "core/import/model_builder.h"
#include "core/import/text.h"
#include "core/types/letter_case.h"
#include "core/types/place.h"
#include "core/types/printable.h"

namespace semblante::import {
namespace {

constexpr std::size_t stl_header_bytes = 80;
constexpr std::size_t facet_bytes = 50;

/// Numbers positions in order of appearance.
class Welder {
 public:
  explicit Welder(std::vector<glm::vec3>& positions) : positions_(positions) {}

  std::uint32_t vertex_at(glm::vec3 position) {
    const auto next = static_cast<std::uint32_t>(positions_.size());
    const auto [entry, is_new] = vertices_.try_emplace(place_key(position), next);
    if (is_new) positions_.push_back(position + 0.0F);  // -0 becomes +0
    return entry->second;
  }

 private:
  std::vector<glm::vec3>& positions_;
  std::unordered_map<PlaceKey, std::uint32_t, PlaceHash> vertices_;
};

Error too_many(const char* what, std::size_t limit) {
  return {ErrorCode::too_large, "", "more than " + std::to_string(limit) + " " + what};
}

Result<Model> read_binary(std::span<const std::uint8_t> bytes, const ImportLimits& limits) {
  if (bytes.size() < stl_header_bytes + 4) {
    return Error{ErrorCode::truncated, "byte " + std::to_string(bytes.size()),
                 "the file ends within the binary STL header of 84 bytes"};
  }
  ByteReader reader(bytes.subspan(stl_header_bytes));
  const auto count = reader.read<std::uint32_t>();
  if (count > reader.left() / facet_bytes) {
    return Error{ErrorCode::truncated, "byte 80",
                 "the STL header declares " + std::to_string(count) + " facets, but the file has bytes for " +
                     std::to_string(reader.left() / facet_bytes)};
  }
  if (count > limits.max_triangles) return too_many("triangles", limits.max_triangles);
  ModelBuilder builder(limits);
  Welder welder(builder.model.positions);
  for (std::uint32_t facet = 0; facet < count; ++facet) {
    reader.skip(12);  // the facet's normal
    std::array<Corner, 3> corners;
    for (Corner& corner : corners) {
      glm::vec3 position(0.0F);
      for (int axis = 0; axis < 3; ++axis) position[axis] = reader.read<float>();
      if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z)) {
        return Error{ErrorCode::not_finite, "facet " + std::to_string(facet), "a coordinate is not a finite number"};
      }
      corner.vertex = welder.vertex_at(position);
    }
    reader.skip(2);  // attributes
    if (builder.model.positions.size() > limits.max_vertices) return too_many("vertices", limits.max_vertices);
    builder.add_triangle(corners[0], corners[1], corners[2]);
  }
  if (reader.left() > 0) builder.warn(std::to_string(reader.left()) + " bytes after the last facet were not read");
  return std::move(builder).finish("stl");
}

/// Text: only "vertex" lines have data; "endfacet" ends a facet of three vertices.
Result<Model> read_text(std::string_view text, const ImportLimits& limits) {
  ModelBuilder builder(limits);
  Welder welder(builder.model.positions);
  LineReader lines(text);
  std::array<Corner, 3> corners;
  std::size_t corner_count = 0;
  bool ended = false;
  const auto error = [&lines](ErrorCode code, std::string message) {
    return Error{code, lines.where(), std::move(message)};
  };
  while (auto line = lines.next()) {
    const std::string_view word = next_token(*line);
    const std::string keyword = lower_case(word);  // some programs write them in upper case
    if (keyword == "vertex") {
      if (corner_count == 3) return error(ErrorCode::malformed, "a facet has more than 3 corners");
      glm::vec3 position(0.0F);
      for (int axis = 0; axis < 3; ++axis) {
        const std::string_view token = next_token(*line);
        switch (parse_number(token, position[axis])) {
          case NumberFault::none:
            break;
          case NumberFault::not_a_number:
            return error(ErrorCode::malformed, "vertex has " + shown(token) + " in place of a number");
          case NumberFault::not_finite:
            return error(ErrorCode::not_finite, "vertex has " + shown(token) + ", which is not a finite number");
        }
      }
      corners[corner_count++].vertex = welder.vertex_at(position);
      if (builder.model.positions.size() > limits.max_vertices) return too_many("vertices", limits.max_vertices);
    } else if (keyword == "endfacet") {
      if (corner_count != 3) return error(ErrorCode::malformed, "a facet has fewer than 3 corners");
      if (builder.triangles_left() == 0) return too_many("triangles", limits.max_triangles);
      builder.add_triangle(corners[0], corners[1], corners[2]);
      corner_count = 0;
    } else if (keyword == "solid") {
      while (!line->empty() && line->front() == ' ') line->remove_prefix(1);
      builder.begin_primitive(printable(*line), -1);
      ended = false;
    } else if (keyword == "endsolid") {
      ended = true;
    } else if (!keyword.empty() && keyword != "facet" && keyword != "outer" && keyword != "endloop") {
      return error(ErrorCode::malformed, shown(word) + " is no word of an STL");
    }
  }
  if (!ended || corner_count != 0) return error(ErrorCode::truncated, "the STL ends without 'endsolid'");
  return std::move(builder).finish("stl");
}

}  // namespace

Result<Model> read_stl(std::span<const std::uint8_t> bytes, const ImportLimits& limits) {
  // Binary headers may begin with "solid" too; only a text continues with "facet" and has no zero byte near the
  // beginning.
  const std::string_view text = as_text(bytes);
  const std::size_t begin = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  const std::string head = lower_case(text.substr(begin, 4096));
  const bool is_text = head.starts_with("solid") && head.find('\0') == std::string::npos &&
                       (head.find("facet") != std::string::npos || head.find("endsolid") != std::string::npos);
  return is_text ? read_text(text, limits) : read_binary(bytes, limits);
}

}  // namespace semblante::import

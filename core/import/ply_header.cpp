#include "core/import/ply_header.h"

#include <charconv>
#include <utility>

#include "core/import/text.h"

namespace semblante::import {
namespace {

constexpr std::size_t max_elements = 64;
constexpr std::size_t max_properties = 256;

std::optional<PlyType> type_of(std::string_view name) {
  if (name == "char" || name == "int8") return PlyType::i8;
  if (name == "uchar" || name == "uint8") return PlyType::u8;
  if (name == "short" || name == "int16") return PlyType::i16;
  if (name == "ushort" || name == "uint16") return PlyType::u16;
  if (name == "int" || name == "int32") return PlyType::i32;
  if (name == "uint" || name == "uint32") return PlyType::u32;
  if (name == "float" || name == "float32") return PlyType::f32;
  if (name == "double" || name == "float64") return PlyType::f64;
  return std::nullopt;
}

/// "property <type> <name>" or "property list <type> <type> <name>"; `rest` is after "property".
std::optional<PlyProperty> parse_property(std::string_view rest) {
  PlyProperty property;
  std::string_view word = next_token(rest);
  if (word == "list") {
    property.list_size = type_of(next_token(rest));
    if (!property.list_size || *property.list_size == PlyType::f32 || *property.list_size == PlyType::f64) {
      return std::nullopt;
    }
    word = next_token(rest);
  }
  const auto type = type_of(word);
  property.name = std::string(next_token(rest).substr(0, 64));
  if (!type || property.name.empty()) return std::nullopt;
  property.type = *type;
  return property;
}

}  // namespace

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::i8:
    case PlyType::u8:
      return 1;
    case PlyType::i16:
    case PlyType::u16:
      return 2;
    case PlyType::i32:
    case PlyType::u32:
    case PlyType::f32:
      return 4;
    case PlyType::f64:
      return 8;
  }
  return 0;
}

std::optional<std::size_t> PlyElement::find(std::string_view property) const {
  for (std::size_t i = 0; i < properties.size(); ++i) {
    if (properties[i].name == property) return i;
  }
  return std::nullopt;
}

std::size_t PlyElement::least_bytes(bool is_text) const {
  std::size_t bytes = 0;
  for (const PlyProperty& property : properties) {
    bytes += is_text ? 2 : size_of(property.list_size.value_or(property.type));
  }
  return bytes;
}

Result<PlyHeader> parse_ply_header(std::span<const std::uint8_t> bytes) {
  LineReader lines(as_text(bytes));
  const auto error = [&lines](ErrorCode code, std::string message) {
    return Error{code, lines.where(), std::move(message)};
  };
  if (lines.next() != "ply") return error(ErrorCode::malformed, "not a PLY file: the first line must be 'ply'");
  PlyHeader header;
  bool has_format = false;
  while (auto line = lines.next()) {
    const std::string_view whole = *line;
    const std::string_view keyword = next_token(*line);
    if (keyword == "format") {
      const std::string_view kind = next_token(*line);
      if (kind == "ascii") {
        header.is_text = true;
      } else if (kind == "binary_big_endian") {
        header.order = std::endian::big;
      } else if (kind != "binary_little_endian") {
        return error(ErrorCode::unsupported, "PLY format " + shown(kind) + " is not supported");
      }
      has_format = true;
    } else if (keyword == "element") {
      PlyElement element;
      element.name = std::string(next_token(*line).substr(0, 64));
      const std::string_view count = next_token(*line);
      const auto [end, fault] = std::from_chars(count.data(), count.data() + count.size(), element.count);
      if (element.name.empty() || count.empty() || fault != std::errc{} || end != count.data() + count.size()) {
        return error(ErrorCode::malformed, shown(whole) + " must be 'element <name> <count>'");
      }
      if (header.elements.size() >= max_elements)
        return error(ErrorCode::too_large, "more than " + std::to_string(max_elements) + " kinds of elements");
      header.elements.push_back(std::move(element));
    } else if (keyword == "property") {
      auto property = parse_property(*line);
      if (!property || header.elements.empty()) {
        return error(ErrorCode::malformed,
                     shown(whole) + " must be 'property [list <type>] <type> <name>' of an element");
      }
      auto& properties = header.elements.back().properties;
      if (properties.size() >= max_properties)
        return error(ErrorCode::too_large, "more than " + std::to_string(max_properties) + " properties");
      properties.push_back(std::move(*property));
    } else if (keyword == "end_header") {
      if (!has_format) return error(ErrorCode::missing, "the header has no 'format'");
      header.data_offset = bytes.size() - lines.rest().size();
      header.line_count = lines.line();
      return header;
    } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
      return error(ErrorCode::malformed, shown(whole) + " is not a line of a PLY header");
    }
  }
  return error(ErrorCode::truncated, "the header ends without 'end_header'");
}

}  // namespace semblante::import

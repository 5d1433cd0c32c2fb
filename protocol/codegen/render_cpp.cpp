#include <stdexcept>

#include "protocol/codegen/render.h"
#include "protocol/codegen/schema.h"

namespace semblante::codegen {
namespace {

std::string cpp_type(const Json& field) {
  const std::string type = text(field, "type");
  if (type == "uint") return field.at("max").get<std::uint64_t>() <= 0xFFFFFFFFU ? "std::uint32_t" : "std::uint64_t";
  if (type == "real") return "double";
  if (type == "bool") return "bool";
  if (type == "text") return "std::string";
  if (type == "bytes") return "std::vector<std::uint8_t>";
  if (type == "reals") return "std::vector<double>";
  if (type == "enum") return text(field, "enum");
  if (type == "optional") return "std::optional<" + text(field, "struct") + ">";
  if (type == "optional_real") return "std::optional<double>";
  if (type == "state") return "FaceFrame";
  if (type == "frames") return "std::vector<TimedFrame>";
  throw std::runtime_error("unknown type of field: " + type);
}

std::string initializer(const Json& field) {
  const std::string type = text(field, "type");
  if (type == "uint") return " = " + std::to_string(field.value("default", std::uint64_t{0}));
  if (type == "real") return " = 0.0";
  if (type == "bool") return " = false";
  if (type == "enum") return "{}";
  return "";
}

std::string bound(const Json& field, const char* key, const char* otherwise) {
  return field.contains(key) ? field.at(key).dump() : otherwise;
}

std::string visit(const Json& field) {
  const std::string type = text(field, "type");
  const std::string name = text(field, "name");
  const std::string presence = required(field)   ? "Presence::required"
                               : appended(field) ? "Presence::appended"
                                                 : "Presence::defaulted";
  const std::string head = "\"" + name + "\", m." + name;
  if (type == "uint") {
    return "v.uint(" + head + ", " + std::to_string(field.at("max").get<std::uint64_t>()) + "U, " + presence + ");";
  }
  if (type == "real") {
    return "v.real(" + head + ", " + bound(field, "min", "-max_real") + ", " + bound(field, "max", "max_real") + ", " +
           presence + ");";
  }
  if (type == "bool") return "v.boolean(" + head + ", " + presence + ");";
  if (type == "text" || type == "bytes")
    return "v." + type + "(" + head + ", " + field.at("max").dump() + ", " + presence + ");";
  if (type == "reals") {
    return "v.reals(" + head + ", " + field.at("lengths").at(1).dump() + ", " + bound(field, "min", "-max_real") +
           ", " + bound(field, "max", "max_real") + ", " + presence + ");";
  }
  if (type == "enum")
    return "v.enumeration(" + head + ", " + snake_case(text(field, "enum")) + "_names, " + presence + ");";
  if (type == "optional") return "v.optional(" + head + ", " + presence + ");";
  if (type == "optional_real") {
    return "v.optional_real(" + head + ", " + bound(field, "min", "-max_real") + ", " +
           bound(field, "max", "max_real") + ");";
  }
  return "v." + type + "(" + head + ");";  // state, frames
}

void render_struct(std::string& out, const Json& record) {
  const std::string name = text(record, "name");
  out += "/// " + text(record, "doc") + "\nstruct " + name + " {\n";
  for (const Json& field : record.at("fields")) {
    out += "  " + cpp_type(field) + " " + text(field, "name") + initializer(field) + ";";
    const std::string doc = documentation(field);
    out += doc.empty() ? "\n" : "  ///< " + doc + "\n";
  }
  out += "  friend bool operator==(const " + name + "&, const " + name + "&) = default;\n};\n\n";
}

void render_visit(std::string& out, const Json& record) {
  out += "template <class M, class V>\n  requires std::same_as<std::remove_const_t<M>, " + text(record, "name") +
         ">\nvoid visit_fields(M& m, V& v) {\n";
  for (const Json& field : record.at("fields")) out += "  " + visit(field) + "\n";
  out += "}\n\n";
}

void render_enum(std::string& out, const Json& node) {
  const std::string name = text(node, "name");
  out += "/// " + text(node, "doc") + "\nenum class " + name + " : std::uint8_t {\n";
  std::string names;
  for (const Json& value : node.at("values")) {
    out += "  " + text(value, "name") + ",  ///< " + text(value, "doc") + "\n";
    names += (names.empty() ? "\"" : ", \"") + text(value, "name") + "\"";
  }
  out += "};\ninline constexpr std::array<std::string_view, " + std::to_string(node.at("values").size()) + "> " +
         snake_case(name) + "_value_names = {" + names + "};\ninline constexpr EnumNames " + snake_case(name) +
         "_names{" + snake_case(name) + "_value_names, " + (node.at("open").get<bool>() ? "true" : "false") + "};\n\n";
}

}  // namespace

std::string render_cpp(const Json& schema) {
  std::string out = R"(// Generated from protocol/schema by semblante-codegen-protocol; change the schema, not this.
// clang-format off
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "protocol/cpp/face_frame.h"

namespace semblante {

/// Whether a field may be left out: a JSON member absent; one that was appended also of the binary form, whose message
/// may end before it.
enum class Presence : std::uint8_t { required, defaulted, appended };

/// Texts of an enumeration by value. An open one reads values it does not know as its first.
struct EnumNames {
  std::span<const std::string_view> names;
  bool open;
};

inline constexpr double max_real = std::numeric_limits<double>::max();

)";
  out += "inline constexpr std::uint32_t protocol_version = " + schema.at("version").dump() + ";\n";
  out +=
      "inline constexpr std::string_view binary_subprotocol = " + schema.at("subprotocols").at("binary").dump() + ";\n";
  out +=
      "inline constexpr std::string_view json_subprotocol = " + schema.at("subprotocols").at("json").dump() + ";\n\n";
  for (const auto& [name, value] : schema.at("limits").items()) {
    out += "inline constexpr std::size_t " + name + " = " + value.dump() + ";\n";
  }
  out += "\n";
  for (const Json& node : schema.at("enums")) render_enum(out, node);
  for (const Json& record : schema.at("structs")) render_struct(out, record);
  std::string variant;
  for (const Json& record : schema.at("messages")) {
    render_struct(out, record);
    variant += (variant.empty() ? "" : ", ") + text(record, "name");
  }
  out += "using Message = std::variant<" + variant + ">;\n\n";
  out +=
      "/// First byte of the binary form and `type` of the JSON form, for each message.\ntemplate <class M>\nstruct "
      "MessageTraits;\n";
  for (const Json& record : schema.at("messages")) {
    out += "template <>\nstruct MessageTraits<" + text(record, "name") +
           "> {\n  static constexpr std::uint8_t type = " + record.at("type").dump() +
           ";\n  static constexpr std::string_view name = \"" + text(record, "wire") + "\";\n};\n";
  }
  out += "\n// visit_fields calls one method of `v` per field, in the order of the binary form.\n\n";
  for (const Json& record : schema.at("structs")) render_visit(out, record);
  for (const Json& record : schema.at("messages")) render_visit(out, record);
  out += "}  // namespace semblante\n";
  return out;
}

}  // namespace semblante::codegen

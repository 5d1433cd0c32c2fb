#include <algorithm>
#include <functional>
#include <map>
#include <stdexcept>

#include "protocol/codegen/render.h"
#include "protocol/codegen/schema.h"

namespace semblante::codegen {
namespace {

std::string bounds(const Json& field) {
  return field.contains("min") ? ", " + field.at("min").dump() + " to " + field.at("max").dump() : std::string();
}

constexpr const char* packed_form = "see \"Packed form\"";

/// The binary form of a field that is there.
std::string value_form(const Json& field) {
  const std::string type = text(field, "type");
  if (type == "uint") return "varint, at most " + field.at("max").dump();
  if (type == "real") return "f64" + bounds(field);
  if (type == "optional_real") return "u8, 0 or 1; if 1, an f64" + bounds(field);
  if (type == "bool") return "u8, 0 or 1";
  if (type == "text") return "text of at most " + field.at("max").dump() + " bytes";
  if (type == "bytes") return "varint number of bytes, at most " + field.at("max").dump() + ", then the bytes";
  if (type == "reals") {
    return "varint count (0 or " + field.at("lengths").at(1).dump() + "), then that many f64, " +
           field.at("min").dump() + " to " + field.at("max").dump();
  }
  if (type == "enum") return "u8, `" + text(field, "enum") + "`";
  if (type == "optional") return "u8, 0 or 1; if 1, a `" + text(field, "struct") + "`";
  return packed_form;  // state, frames
}

std::string wire_form(const Json& field) {
  return (appended(field) ? "appended: nothing, or " : "") + value_form(field);
}

std::string field_table(const Json& record) {
  const Json& fields = record.at("fields");
  const bool is_batch =
      std::any_of(fields.begin(), fields.end(), [](const Json& f) { return f.at("type") == "frames"; });
  std::string out = "| field | binary form | meaning |\n|---|---|---|\n";
  for (const Json& field : fields) {
    out += "| `" + text(field, "name") + (required(field) ? "` (required)" : "`") + " | " +
           (is_batch ? packed_form : wire_form(field)) + " | " + documentation(field) + " |\n";
  }
  return out;
}

std::string message_tables(const Json& schema) {
  std::string out;
  for (const Json& record : schema.at("messages")) {
    out += "### " + record.at("type").dump() + " `" + text(record, "wire") + "` (from " + text(record, "from") +
           ")\n\n" + text(record, "doc") + "\n\n" + field_table(record) + "\n";
  }
  for (const Json& record : schema.at("structs")) {
    out += "### `" + text(record, "name") + "`\n\n" + text(record, "doc") + "\n\n" + field_table(record) + "\n";
  }
  return out;
}

std::string enum_tables(const Json& schema) {
  std::string out;
  for (const Json& node : schema.at("enums")) {
    out += "### `" + text(node, "name") + "` (" + (node.at("open").get<bool>() ? "open" : "closed") + ")\n\n" +
           text(node, "doc") + "\n\n| value | name | meaning |\n|---|---|---|\n";
    for (std::size_t i = 0; i < node.at("values").size(); ++i) {
      const Json& value = node.at("values").at(i);
      out += "| " + std::to_string(i) + " | `" + text(value, "name") + "` | " + text(value, "doc") + " |\n";
    }
    out += "\n";
  }
  return out;
}

std::string limit_table(const Json& schema) {
  std::string out = "| limit | value |\n|---|---|\n";
  for (const auto& [name, value] : schema.at("limits").items()) out += "| `" + name + "` | " + value.dump() + " |\n";
  return out;
}

}  // namespace

std::string render_spec(const Json& schema, const Json& packed, const std::string& spec) {
  const std::map<std::string, std::function<std::string()>> sections = {
      {"messages", [&] { return message_tables(schema); }},
      {"enums", [&] { return enum_tables(schema); }},
      {"limits", [&] { return limit_table(schema); }},
      {"faps", fap_table},
      {"feature point groups", feature_point_group_table},
      {"feature points", feature_point_table},
      {"fapus", fapu_table},
      {"companions", companion_table},
      {"selects", select_table},
      {"groups", fap_group_table},
      {"packed tables", [&] { return packed_table_list(packed); }},
      {"packed references", [&] { return packed_reference_list(packed); }},
  };
  const std::string open = "<!-- generated: ";
  const std::string close = "<!-- end -->";
  std::string out;
  std::size_t at = 0;
  for (std::size_t found = spec.find(open); found != std::string::npos; found = spec.find(open, at)) {
    const std::size_t name_at = found + open.size();
    const std::size_t name_end = spec.find(" -->", name_at);
    const std::size_t end = spec.find(close, name_at);
    if (name_end == std::string::npos || end == std::string::npos)
      throw std::runtime_error("SPEC.md: marker without end");
    const std::string name = spec.substr(name_at, name_end - name_at);
    out += spec.substr(at, name_end + 4 - at) + "\n" + sections.at(name)() + close;
    at = end + close.size();
  }
  return out + spec.substr(at);
}

}  // namespace semblante::codegen

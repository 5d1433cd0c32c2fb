#include <stdexcept>

#include "protocol/codegen/render.h"
#include "protocol/codegen/schema.h"

namespace semblante::codegen {
namespace {

std::string ts_type(const Json& field) {
  const std::string type = text(field, "type");
  if (type == "uint" || type == "real") return "number";
  if (type == "bool") return "boolean";
  if (type == "text") return "string";
  if (type == "bytes") return "Uint8Array";
  if (type == "reals") return "number[]";
  if (type == "enum") return text(field, "enum");
  if (type == "optional") return text(field, "struct") + " | null";
  if (type == "optional_real") return "number | null";
  if (type == "state") return "FaceFrame";
  if (type == "frames") return "TimedFrame[]";
  throw std::runtime_error("unknown type of field: " + type);
}

std::string fallback(const Json& field, const Json& schema) {
  const std::string type = text(field, "type");
  if (type == "uint" || type == "real") return field.value("default", Json(0)).dump();
  if (type == "bool") return "false";
  if (type == "text") return "''";
  if (type == "bytes") return "new Uint8Array()";
  if (type == "reals") return "[]";
  if (type == "optional" || type == "optional_real") return "null";
  if (type == "enum") {
    for (const Json& node : schema.at("enums")) {
      if (node.at("name") == field.at("enum")) return "'" + text(node.at("values").at(0), "name") + "'";
    }
  }
  return "undefined";
}

std::string descriptor(const Json& field, const Json& schema) {
  const std::string type = text(field, "type");
  std::string out = "{ name: '" + text(field, "name") + "', type: '" + type + "'";
  if (type == "uint" || type == "text" || type == "bytes") out += ", max: " + field.at("max").dump();
  if (type == "real" || type == "reals" || type == "optional_real") {
    out += ", min: " + (field.contains("min") ? field.at("min").dump() : "-1.7976931348623157e308");
    out += ", max: " + (field.contains("max") ? field.at("max").dump() : "1.7976931348623157e308");
  }
  if (type == "reals") out += ", length: " + field.at("lengths").at(1).dump();
  if (type == "enum") out += ", values: " + snake_case(text(field, "enum")) + "_values";
  if (type == "optional") out += ", fields: " + snake_case(text(field, "struct")) + "_fields";
  if (appended(field)) out += ", appended: true";
  if (type != "state" && type != "frames") {
    out +=
        std::string(", required: ") + (required(field) ? "true" : "false") + ", fallback: " + fallback(field, schema);
  }
  return out + " }";
}

void render_interface(std::string& out, const Json& record) {
  out += "/** " + text(record, "doc") + " */\nexport interface " + text(record, "name") + " {\n";
  if (record.contains("wire")) out += "  type: '" + text(record, "wire") + "';\n";
  for (const Json& field : record.at("fields")) {
    const std::string doc = documentation(field);
    if (!doc.empty()) out += "  /** " + doc + " */\n";
    out += "  " + text(field, "name") + ": " + ts_type(field) + ";\n";
  }
  out += "}\n\n";
}

void render_fields(std::string& out, const Json& record, const Json& schema) {
  for (const Json& field : record.at("fields")) out += "  " + descriptor(field, schema) + ",\n";
}

}  // namespace

std::string render_typescript(const Json& schema) {
  std::string out = R"(// Generated from protocol/schema by semblante-codegen-protocol; change the schema, not this.

import type { FaceFrame, TimedFrame } from '../face_frame.ts';

)";
  out += "export const protocolVersion = " + schema.at("version").dump() + ";\n";
  out += "export const binarySubprotocol = '" + text(schema.at("subprotocols"), "binary") + "';\n";
  out += "export const jsonSubprotocol = '" + text(schema.at("subprotocols"), "json") + "';\n\n";
  out += "export const limits = {\n";
  for (const auto& [name, value] : schema.at("limits").items()) out += "  " + name + ": " + value.dump() + ",\n";
  out += "} as const;\n\n";
  for (const Json& node : schema.at("enums")) {
    std::string names;
    for (const Json& value : node.at("values")) names += (names.empty() ? "'" : " | '") + text(value, "name") + "'";
    out += "/** " + text(node, "doc") + " */\nexport type " + text(node, "name") + " = " + names + ";\n\n";
  }
  for (const Json& record : schema.at("structs")) render_interface(out, record);
  std::string variant;
  for (const Json& record : schema.at("messages")) {
    render_interface(out, record);
    variant += (variant.empty() ? "" : " | ") + text(record, "name");
  }
  out += "export type Message = " + variant + ";\n\n";
  out += R"(/** Texts of an enumeration by value. An open one reads values it does not know as its first. */
export interface EnumValues {
  readonly names: readonly string[];
  readonly open: boolean;
}

/** One field, in the order of the binary form. */
export type Field =
  | { name: string; type: 'uint'; max: number; required: boolean; fallback: number }
  | { name: string; type: 'real'; min: number; max: number; required: boolean; fallback: number }
  | { name: string; type: 'bool'; appended?: true; required: boolean; fallback: boolean }
  | { name: string; type: 'text'; max: number; required: boolean; fallback: string }
  | { name: string; type: 'bytes'; max: number; required: boolean; fallback: Uint8Array }
  | { name: string; type: 'reals'; min: number; max: number; length: number; required: boolean; fallback: number[] }
  | { name: string; type: 'enum'; values: EnumValues; appended?: true; required: boolean; fallback: string }
  | { name: string; type: 'optional'; fields: readonly Field[]; appended?: true; required: boolean; fallback: null }
  | { name: string; type: 'optional_real'; min: number; max: number; appended: true; required: boolean; fallback: null }
  | { name: string; type: 'state' }
  | { name: string; type: 'frames' };

/** A field that was not there at first: where a message has its default, it is left out or the message ends before it. */
export function isAppended(field: Field): field is Field & { fallback: unknown } {
  return 'appended' in field && field.appended === true;
}

/** A message: the first byte of its binary form, `type` of its JSON form, its fields. */
export interface MessageDescription {
  readonly type: number;
  readonly name: Message['type'];
  readonly fields: readonly Field[];
}

)";
  for (const Json& node : schema.at("enums")) {
    std::string names;
    for (const Json& value : node.at("values")) names += (names.empty() ? "'" : ", '") + text(value, "name") + "'";
    out += "const " + snake_case(text(node, "name")) + "_values: EnumValues = { names: [" + names +
           "], open: " + (node.at("open").get<bool>() ? "true" : "false") + " };\n";
  }
  out += "\n";
  for (const Json& record : schema.at("structs")) {
    out += "const " + snake_case(text(record, "name")) + "_fields: readonly Field[] = [\n";
    render_fields(out, record, schema);
    out += "];\n";
  }
  out += "\nexport const messages: readonly MessageDescription[] = [\n";
  for (const Json& record : schema.at("messages")) {
    out +=
        "  {\n    type: " + record.at("type").dump() + ",\n    name: '" + text(record, "wire") + "',\n    fields: [\n";
    for (const Json& field : record.at("fields")) out += "      " + descriptor(field, schema) + ",\n";
    out += "    ],\n  },\n";
  }
  out += "];\n";
  return out;
}

}  // namespace semblante::codegen

#include "protocol/codegen/render.h"
#include "protocol/codegen/schema.h"

namespace semblante::codegen {
namespace {

std::string all_values(const Json& packed, const std::string& comment, const std::string& indent) {
  std::string out;
  for (const Json& table : packed.at("tables")) {
    out += indent + comment + text(table, "name") + "\n" + numbers(table.at("values"), indent) + ",\n";
  }
  return out;
}

}  // namespace

std::string render_packed_cpp(const Json& packed) {
  std::string out = R"(// Generated from protocol/schema by semblante-codegen-protocol; change the schema, not this.
// clang-format off
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

/// What the packed form knows beforehand: SPEC.md, "Packed form".
namespace semblante::packed_tables {

/// By FAP: one coded before it that often moves as it does; 0: none.
)";
  out += "inline constexpr std::array<std::uint8_t, 69> references = {\n" + numbers(packed.at("references"), "    ") +
         "};\n\n// The first context of each table.\n";
  std::size_t at = 0;
  for (const Json& table : packed.at("tables")) {
    const std::string doc = text(table, "doc");
    out += "inline constexpr std::size_t " + text(table, "name") + " = " + std::to_string(at) + ";" +
           (doc.empty() ? "\n" : "  ///< " + doc + "\n");
    at += table.at("values").size();
  }
  out += "inline constexpr std::size_t size = " + std::to_string(at) + ";\n\n";
  out +=
      "/// By context: the probability of a 1 in 4096ths.\ninline constexpr std::array<std::uint16_t, size> values = "
      "{\n" +
      all_values(packed, "// ", "    ") + "};\n\n}  // namespace semblante::packed_tables\n";
  return out;
}

std::string packed_table_list(const Json& packed) {
  std::string out = "| table | contexts | index |\n|---|---|---|\n";
  for (const Json& table : packed.at("tables")) {
    out += "| `" + text(table, "name") + "` | " + std::to_string(table.at("values").size()) + " | " +
           text(table, "doc") + " |\n";
  }
  return out;
}

std::string packed_reference_list(const Json& packed) {
  std::string out = "| FAP | reference |\n|---|---|\n";
  for (std::size_t fap = 3; fap < packed.at("references").size(); ++fap) {
    const Json& reference = packed.at("references").at(fap);
    if (reference != 0) out += "| " + std::to_string(fap) + " | " + reference.dump() + " |\n";
  }
  return out;
}

}  // namespace semblante::codegen

#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace semblante::codegen {

/// Reads protocol/schema/messages.json. Throws std::exception on any fault: this runs at development time only.
nlohmann::ordered_json read_schema(const std::string& path);

/// protocol/cpp/generated/messages.h: structs, enums and `visit_fields`, from which the codecs are templates.
std::string render_cpp(const nlohmann::ordered_json& schema);
/// protocol/ts/generated/messages.ts: interfaces, and the same description as data, which the codecs interpret.
std::string render_typescript(const nlohmann::ordered_json& schema);
/// SPEC.md with the text between each pair of `<!-- generated: NAME -->` and `<!-- end -->` made anew.
std::string render_spec(const nlohmann::ordered_json& schema, const std::string& spec);

}  // namespace semblante::codegen

#pragma once

#include <cstdint>
#include <string>

#include <nlohmann/json.hpp>

#include "core/codegen/generator.h"

/// Queries on the schema that all renderers use.
namespace semblante::codegen {

using Json = nlohmann::ordered_json;

inline std::string text(const Json& node, const char* key) { return node.value(key, std::string()); }
inline bool required(const Json& field) { return field.value("required", false); }
/// A field that was not there at first: every `optional_real`, and others marked as such.
inline bool appended(const Json& field) {
  return text(field, "type") == "optional_real" || field.value("appended", false);
}
/// A field's documentation with its unit in front: "ms, since 1970".
std::string documentation(const Json& field);
/// Lines of at most 20 numbers.
std::string numbers(const Json& values, const std::string& indent);

}  // namespace semblante::codegen

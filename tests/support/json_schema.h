#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace semblante::test {

/// Whether objects may have members that their schema does not name and says nothing about.
enum class UnknownMembers { allowed, refused };

/// What is wrong with `value` against a schema (JSON Schema 2020-12), each fault with the JSON pointer into the value;
/// empty when the value is right. `document` is what `$ref` points into. `refused` treats every object whose schema
/// names members, and does not say `additionalProperties`, as if it said `"unevaluatedProperties": false`.
/// Throws std::logic_error on a keyword that the validator does not know, wherever the value meets it: a rule that
/// nobody checks must not look like one.
std::vector<std::string> schema_faults(const nlohmann::json& document, const nlohmann::json& schema,
                                       const nlohmann::json& value, UnknownMembers unknown);

}  // namespace semblante::test

#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/codegen/generator.h"

/// Queries on an OpenAPI document that several renderers use.
namespace semblante::codegen {

using Json = nlohmann::ordered_json;

struct Operation {
  std::string method;    ///< "GET"
  std::string pattern;   ///< "/v1/models/{model}"
  std::string function;  ///< "get_model"
  const Json* json;
};
std::vector<Operation> operations(const Json& document);

/// The target of a `$ref`; the node itself if it is not a reference.
const Json& follow(const Json& document, const Json& node);
/// "#/components/schemas/Model" -> "Model"; empty when the schema is not a reference.
std::string component_name(const Json& schema);

/// "by_user" -> "ByUser".
std::string pascal_case(const std::string& name);
/// "a" -> "\"a\"", with escapes.
std::string quoted(const std::string& text);
/// The first lines of each generated C++ file.
std::string generated_notice();

}  // namespace semblante::codegen

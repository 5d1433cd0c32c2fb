#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

/// Questions to an OpenAPI document that several renderers ask.
namespace semblante::codegen {

using Json = nlohmann::ordered_json;

struct Operation {
  std::string method;    ///< "GET"
  std::string pattern;   ///< "/v1/models/{model}"
  std::string function;  ///< "get_model"
  const Json* json;
};
std::vector<Operation> operations(const Json& document);

/// What a `$ref` points to; the node itself where it is none.
const Json& follow(const Json& document, const Json& node);
/// "#/components/schemas/Model" -> "Model"; empty where the schema is no reference.
std::string component_name(const Json& schema);

/// "getModel" -> "get_model".
std::string snake_case(const std::string& name);
/// "by_user" -> "ByUser".
std::string pascal_case(const std::string& name);
/// "a" -> "\"a\"", with escapes.
std::string quoted(const std::string& text);
/// The head of each generated C++ file.
std::string generated_notice();

}  // namespace semblante::codegen

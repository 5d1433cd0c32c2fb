#include "server/api/codegen/api_document.h"

#include <cctype>

namespace semblante::codegen {

std::vector<Operation> operations(const Json& document) {
  std::vector<Operation> list;
  for (const auto& [pattern, item] : document.at("paths").items()) {
    for (const auto& [name, operation] : item.items()) {
      std::string method = name;
      for (char& c : method) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
      list.push_back({method, pattern, snake_case(operation.at("operationId").get<std::string>()), &operation});
    }
  }
  return list;
}

const Json& follow(const Json& document, const Json& node) {
  const auto ref = node.find("$ref");
  return ref == node.end() ? node : document.at(Json::json_pointer(ref->get<std::string>().substr(1)));
}

std::string component_name(const Json& schema) {
  const auto ref = schema.value("$ref", std::string());
  return ref.substr(ref.rfind('/') + 1);
}

std::string pascal_case(const std::string& name) {
  std::string result;
  bool begins = true;
  for (const char c : name) {
    if (c != '_') result += begins ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    begins = c == '_';
  }
  return result;
}

std::string quoted(const std::string& text) { return Json(text).dump(); }

std::string generated_notice() { return "// Generated from server/api/openapi.json by semblante-codegen-api.\n"; }

}  // namespace semblante::codegen

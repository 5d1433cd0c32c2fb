#include "tests/support/api_exchange.h"

#include <algorithm>
#include <fstream>

#include <nlohmann/json.hpp>

#include "core/types/letter_case.h"
#include "tests/support/json_schema.h"

namespace semblante::test {
namespace {

using nlohmann::json;
using Faults = std::vector<std::string>;

const std::string problem_type = "application/problem+json";

/// "application/json; charset=utf-8" -> "application/json".
std::string essence(const std::string& type) { return type.substr(0, std::min(type.find(';'), type.size())); }

bool is_json(const std::string& type) { return type.ends_with("json"); }

std::vector<std::string> segments(const std::string& path) {
  std::vector<std::string> list(1);
  for (const char c : path) {
    if (c == '/')
      list.emplace_back();
    else
      list.back().push_back(c);
  }
  return list;
}

bool fits(const std::string& pattern, const std::string& path) {
  const auto expected = segments(pattern);
  const auto actual = segments(path);
  return std::equal(expected.begin(), expected.end(), actual.begin(), actual.end(),
                    [](const auto& e, const auto& a) { return e.starts_with('{') ? !a.empty() : e == a; });
}

/// The methods of a path; null when there is no such path.
const json* path_item(const json& document, const std::string& path) {
  for (const auto& [pattern, item] : document.at("paths").items())
    if (fits(pattern, path)) return &item;
  return nullptr;
}

const json& follow(const json& document, const json& node) {
  const auto ref = node.find("$ref");
  return ref == node.end() ? node : document.at(json::json_pointer(ref->get<std::string>().substr(1)));
}

Faults body_faults(const json& document, const json& media, const std::string& type, const std::string& body,
                   UnknownMembers unknown) {
  const auto schema = media.find("schema");
  if (schema == media.end()) return {};  // bytes
  const json value = is_json(type) ? json::parse(body, nullptr, false) : json(body);
  if (value.is_discarded()) return {"the body is no JSON"};
  return schema_faults(document, *schema, value, unknown);
}

/// The answer against a response object.
Faults response_faults(const json& document, const json& response, const ApiExchange& exchange) {
  if (exchange.method == "HEAD") return {};
  if (!response.contains("content")) {
    constexpr int part_of_something = 206;  // by Range: it has no schema of its own
    if (exchange.body.empty() || exchange.status == part_of_something) return {};
    return {"the answer has a body, which the document does not know"};
  }
  const auto& content = response["content"];
  const auto type = essence(exchange.type);
  if (!content.contains(type) && !content.contains("*/*")) return {"the document does not know the media type " + type};
  return body_faults(document, content.contains(type) ? content[type] : content["*/*"], type, exchange.body,
                     UnknownMembers::refused);
}

Faults problem_faults(const json& document, const ApiExchange& exchange) {
  return response_faults(document, document.at("components").at("responses").at("Problem"), exchange);
}

/// Of an answer that no operation gave.
Faults faults_outside(const json& document, const ApiExchange& exchange) {
  if (exchange.method == "OPTIONS" && exchange.status == 204) return {};
  if (exchange.status >= 400) return problem_faults(document, exchange);
  if (exchange.target.starts_with("/v1/")) return {"there is no such operation, and yet it is answered"};
  return {};  // a page
}

Faults request_faults(const json& document, const json& operation, const ApiExchange& exchange) {
  if (exchange.status >= 300 || exchange.request_body.empty()) return {};
  const auto type = exchange.request_type.empty() ? std::string("application/json") : essence(exchange.request_type);
  if (!operation.contains("requestBody")) return {};  // HTTP allows one with each request: it is ignored
  const auto& content = follow(document, operation["requestBody"]).at("content");
  if (!content.contains(type)) return {"a body of the type " + type + " was taken, which the document does not know"};
  if (!is_json(type)) return {};
  return body_faults(document, content[type], type, exchange.request_body, UnknownMembers::allowed);
}

}  // namespace

Faults exchange_faults(const json& document, const ApiExchange& exchange) {
  const auto* const item = path_item(document, exchange.target.substr(0, exchange.target.find('?')));
  const std::string method = lower_case(exchange.method == "HEAD" ? "GET" : exchange.method);
  if (item == nullptr || !item->contains(method)) return faults_outside(document, exchange);
  const auto& operation = item->at(method);
  const auto& responses = operation.at("responses");
  const auto status = std::to_string(exchange.status);
  const auto listed = responses.contains(status) ? responses.find(status) : responses.find("default");
  if (listed == responses.end()) return {"the operation does not list the status " + status};
  auto faults = response_faults(document, follow(document, *listed), exchange);
  const auto more = request_faults(document, operation, exchange);
  faults.insert(faults.end(), more.begin(), more.end());
  return faults;
}

Faults exchange_faults(const ApiExchange& exchange) {
  static const json document = [] {
    std::ifstream file(SEMBLANTE_SOURCE_DIR "/server/api/openapi.json", std::ios::binary);
    return json::parse(file);
  }();
  return exchange_faults(document, exchange);
}

}  // namespace semblante::test

#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace semblante::test {

/// One request to the API and its answer.
struct ApiExchange {
  std::string method, target;  ///< as in the request line
  std::string request_type, request_body;
  int status = 0;
  std::string type, body;  ///< of the answer; the type is the whole Content-Type
};

/// What is wrong with the answer against an OpenAPI document: a status or media type that the operation does not list,
/// or a body against its schema, with members that the schema does not know counted as faults. An answer that no
/// operation gives (no such route or method, a request refused before its route was looked for) must be a problem
/// document or a page. A JSON body that the server took must fit the schema of request bodies. Empty: nothing.
std::vector<std::string> exchange_faults(const nlohmann::json& document, const ApiExchange& exchange);

/// The same against server/api/openapi.json of this source tree.
std::vector<std::string> exchange_faults(const ApiExchange& exchange);

}  // namespace semblante::test

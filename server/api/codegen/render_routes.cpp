#include <algorithm>
#include <array>
#include <set>
#include <stdexcept>

#include "server/access/scope.h"
#include "server/api/codegen/render.h"

namespace semblante::codegen {
namespace {

/// The media type of the successful answers, for content negotiation; "" when they have no body, "*/*" when there are
/// several types or stored bytes are sent.
std::string produced_type(const Json& document, const Operation& operation) {
  std::set<std::string> types;
  for (const auto& [status, node] : operation.json->at("responses").items()) {
    // A 206 has the media type of the 200.
    if (status[0] != '2' || status == "206") continue;
    const Json& response = follow(document, node);
    if (!response.contains("content")) continue;
    for (const auto& [type, media] : response["content"].items()) types.insert(media.contains("schema") ? type : "*/*");
  }
  if (types.empty()) return "";
  return types.size() == 1 ? *types.begin() : "*/*";
}

std::string body_of(const Operation& operation) {
  if (!operation.json->contains("requestBody")) return "{}";
  const Json& body = operation.json->at("requestBody");
  const std::string kind = body.value("x-body", std::string("json"));
  if (kind != "json" && kind != "json_or_models" && kind != "upload" && kind != "performance" && kind != "fap")
    throw std::runtime_error(operation.function + ": there is no x-body " + kind);
  const bool announced = operation.json->at("responses").contains("411");
  if (announced && !body.value("required", false))
    throw std::runtime_error(operation.function + ": 411 for a body that may be left out");
  return "{BodyKind::" + kind + ", " + operation.function + "_types, " + (announced ? "true" : "false") + "}";
}

/// The names of an operation's query parameters, as a list of C++.
std::string query_names(const Json& document, const Operation& operation) {
  std::string list;
  for (const auto& node : operation.json->value("parameters", Json::array()))
    if (const Json& parameter = follow(document, node); parameter.at("in") == "query")
      list += (list.empty() ? "" : ", ") + quoted(parameter.at("name"));
  return list;
}

constexpr auto& scopes = access::scope_names;

std::string scope_of(const Operation& operation) {
  auto scope = operation.json->value("x-scope", std::string());
  if (std::find(scopes.begin(), scopes.end(), scope) == scopes.end())
    throw std::runtime_error(operation.function + ": x-scope must be none, read, publish, edit or admin");
  const bool is_open = operation.json->contains("security") && operation.json->at("security").empty();
  if (is_open != (scope == "none"))
    throw std::runtime_error(operation.function + ": \"security\": [] and x-scope none belong together");
  return scope;
}

}  // namespace

std::string render_handlers(const Json& document) {
  std::string text =
      generated_notice() + "#pragma once\n\n#include \"server/api/api.h\"\n\nnamespace semblante::api {\n\n";
  for (const auto& operation : operations(document))
    text += "http::Response " + operation.function + "(Context&, http::Request&);\n";
  return text + "\n}  // namespace semblante::api\n";
}

std::string render_route_table(const Json& document) {
  std::string types, rows;
  for (const auto& operation : operations(document)) {
    if (operation.json->contains("requestBody")) {
      std::string list;
      for (const auto& [type, media] : operation.json->at("requestBody").at("content").items())
        list += (list.empty() ? "" : ", ") + quoted(type);
      types += "constexpr auto " + operation.function + "_types = std::to_array<std::string_view>({" + list + "});\n";
    }
    const auto query = query_names(document, operation);
    if (!query.empty())
      types += "constexpr auto " + operation.function + "_query = std::to_array<std::string_view>({" + query + "});\n";
    const auto runs = operation.json->value("x-runs", std::string("on-worker"));
    if (runs != "on-worker" && runs != "at-once")
      throw std::runtime_error(operation.function + ": there is no x-runs " + runs);
    rows += "    {" + quoted(operation.method) + ", " + quoted(operation.pattern) + ", " +
            (query.empty() ? "{}" : operation.function + "_query") + ", " + body_of(operation) + ", " +
            quoted(produced_type(document, operation)) + ", " + operation.function +
            ", Runs::" + (runs == "at-once" ? "at_once" : "on_worker") + ", access::Scope::" + scope_of(operation) +
            "},\n";
  }
  return generated_notice() +
         "#include <array>\n\n#include \"server/api/generated/handlers.h\"\n#include \"server/api/routes.h\"\n\n"
         "namespace semblante::api {\nnamespace {\n\n" +
         types + "\nconstexpr auto table = std::to_array<Route>({\n" + rows +
         "});\n\n}  // namespace\n\nstd::span<const Route> routes() { return table; }\n\n}  // namespace "
         "semblante::api\n";
}

std::string render_scopes(const Json& document) {
  std::string rows;
  for (const auto& operation : operations(document))
    rows += "| " + operation.method + " `" + operation.pattern + "` | " + scope_of(operation) + " | " +
            operation.json->at("summary").get<std::string>() + " |\n";
  return "# What each scope may do\n\n"
         "Generated from server/api/openapi.json by semblante-codegen-api (`x-scope`). A scope includes those before "
         "it: "
         "none, read, publish,\nedit, admin. none: without a token. A GET includes HEAD; OPTIONS is answered without a "
         "token.\n\n"
         "A token for one stream is accepted by that stream's routes, and for reading the model that the stream shows; "
         "a "
         "token\nfor one model by that model's routes and its jobs. Lists and everything else are refused. A stream "
         "with "
         "`is_public` is\nopen for reading, with its model, without a token.\n\n"
         "| route | scope | |\n|---|---|---|\n" +
         rows +
         "| WebSocket `/v1/streams/{stream}`, role `subscribe` | read | |\n"
         "| WebSocket `/v1/streams/{stream}`, role `publish` | publish | |\n";
}

}  // namespace semblante::codegen

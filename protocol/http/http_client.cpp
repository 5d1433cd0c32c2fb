#include "protocol/http/http_client.h"

#include <algorithm>

#include "core/json/json_cursor.h"
#include "core/json/json_tree.h"

namespace semblante::client {

std::string words_of(const HttpResponse& response) {
  std::string words = "the server answered " + std::to_string(response.status);
  const auto document =
      read_json_object_tree(response.body, {.max_bytes = 1U << 20U, .max_depth = 16, .max_values = 10'000});
  if (!document) return words;
  const auto member_of = [&](const char* name) {
    JsonCursor::Report report;
    return JsonCursor(*document, report).text_or(name, "");
  };
  for (const char* member : {"title", "pointer", "detail"}) {
    const std::string text = member_of(member);
    if (!text.empty()) words += ": " + text.substr(0, 500);
  }
  if (const auto advice = find_advice(member_of("advice"))) words.append(": ").append(text_of(*advice).words);
  return words;
}

std::string_view HttpResponse::header(std::string_view name) const {
  const auto found = std::find_if(headers.begin(), headers.end(), [&](const auto& h) { return h.first == name; });
  return found == headers.end() ? std::string_view() : std::string_view(found->second);
}

Result<HttpResponse> HttpClient::get(std::string_view target) const {
  HttpRequest request;
  request.target = target;
  return send(request);
}

Result<HttpResponse> HttpClient::post(std::string_view target, std::string body, std::string content_type) const {
  HttpRequest request;
  request.method = "POST";
  request.target = target;
  request.body = std::move(body);
  request.content_type = std::move(content_type);
  return send(request);
}

Result<std::string> HttpClient::fetch(std::string_view target, std::optional<std::size_t> max_body) const {
  HttpClient bounded = *this;
  bounded.limits_.max_body = std::min(limits_.max_body, max_body.value_or(limits_.max_body));
  auto response = bounded.get(target);
  if (!response) {
    return std::move(response).error();
  }
  if (response->status != 200) {
    const ErrorCode code = response->status == 404 ? ErrorCode::missing : ErrorCode::io;
    return Error{code, std::string(target), words_of(*response)};
  }
  return std::move(response->body);
}

}  // namespace semblante::client

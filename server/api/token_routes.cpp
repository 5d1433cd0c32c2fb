#include <ctime>

#include <nlohmann/json.hpp>

#include "server/access/new_token.h"
#include "server/api/authorization.h"
#include "server/api/common.h"
#include "server/api/generated/body_members.h"
#include "server/api/generated/handlers.h"

namespace semblante::api {
namespace {

constexpr std::size_t max_id_bytes = 64;
constexpr std::int64_t longest_life = std::int64_t{10} * 365 * 24 * 3600;  ///< seconds

answer::Token listed(const store::TokenRecord& token) {
  return {.id = token.id,
          .name = token.name,
          .scope = std::string_view(token.scope),
          .stream = text_or_null(token.stream),
          .model = text_or_null(token.model),
          .created = token.created,
          .expires = token.expires ? std::optional(store::timestamp_of(*token.expires)) : std::nullopt,
          .expired = token.expires && *token.expires <= static_cast<std::int64_t>(std::time(nullptr))};
}

std::string optional_text(const JsonBody& body, const char* name, std::size_t max) {
  const auto found = body.find(name);
  if (found == body.end() || found->is_null()) return {};
  return checked_text(*found, max, std::string("/") + name);
}

access::TokenWish wish_of(Context& context, const JsonBody& body) {
  refuse_unknown_members(body, body_members::create_token);
  access::TokenWish wish;
  wish.name = optional_text(body, "name", max_name_bytes);
  const auto scope = access::parse_scope(optional_text(body, "scope", max_id_bytes));
  if (!scope) refuse("invalid-field", "it must be " + access::token_scopes_in_words(), "/scope");
  wish.scope = *scope;
  wish.stream = optional_text(body, "stream", max_id_bytes);
  wish.model = optional_text(body, "model", max_id_bytes);
  if (!wish.stream.empty() && !wish.model.empty())
    refuse("invalid-field", "a token is for one stream or one model, not both", "/model");
  if (wish.scope == access::Scope::admin && !(wish.stream.empty() && wish.model.empty()))
    refuse("invalid-field", "the scope admin is not limited to a stream or a model", "/scope");
  if (!wish.stream.empty() && !context.hub.info(wish.stream))
    refuse("invalid-field", "there is no stream " + wish.stream, "/stream");
  if (!wish.model.empty() && !context.store.model(wish.model))
    refuse("invalid-field", "there is no model " + wish.model, "/model");
  if (const auto life = body.find("expires_in"); life != body.end() && !life->is_null()) {
    const double seconds = life->is_number_integer() ? life->get<double>() : 0.0;
    if (!(seconds >= 1.0 && seconds <= static_cast<double>(longest_life)))
      refuse("invalid-field", "it must be a whole number of seconds, from 1 to ten years", "/expires_in");
    wish.life = static_cast<std::int64_t>(seconds);
  }
  return wish;
}

}  // namespace

http::Response list_tokens(Context& context, http::Request&) {
  answer::Tokens all{.tokens = {}};
  for (const auto& token : context.store.tokens()) all.tokens.push_back(listed(token));
  return json_response(200, all);
}

http::Response create_token(Context& context, http::Request& request) {
  const auto made = access::make_token(wish_of(context, body_object(request)));
  context.store.add_token(made.record);
  context.config.security.tokens->load(context.store);
  auto response = json_response(201, answer::NewToken{.token = listed(made.record), .secret = made.text});
  response.headers["Location"] = "/v1/tokens/" + made.record.id;
  response.headers["Cache-Control"] = "no-store";
  return response;
}

http::Response delete_token(Context& context, http::Request& request) {
  const auto& id = request.params.at("token");
  if (!context.store.remove_token(id)) refuse("not-found", "there is no token " + id);
  context.config.security.tokens->load(context.store);
  http::Response response;
  response.status = 204;
  return response;
}

}  // namespace semblante::api

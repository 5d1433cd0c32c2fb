#include <algorithm>
#include <charconv>
#include <shared_mutex>

#include <nlohmann/json.hpp>

#include "core/types/rig.h"
#include "server/api/common.h"
#include "server/api/routes.h"
#include "server/http/conditional.h"

namespace semblante::api {
namespace {

constexpr std::size_t default_page = 50;
constexpr std::size_t max_page = 200;
constexpr std::size_t max_name_bytes = 200;

std::size_t page_size(const http::Request& request) {
  const auto text = request.query_value("limit");
  if (!text) return default_page;
  std::size_t limit = 0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), limit);
  if (error != std::errc() || end != text->data() + text->size() || limit == 0 || limit > max_page)
    refuse("invalid-argument", "limit is a number from 1 to " + std::to_string(max_page), "?limit");
  return limit;
}

std::vector<store::RoleChange> role_changes(const Json& roles, std::size_t part_count) {
  if (!roles.is_object()) refuse("invalid-field", "roles is an object of part indices", "/roles");
  std::vector<store::RoleChange> changes;
  for (const auto& [key, value] : roles.items()) {
    const auto pointer = std::string("/roles/").append(http::pointer_segment(key));
    std::uint32_t part = 0;
    const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), part);
    if (error != std::errc() || end != key.data() + key.size() || part >= part_count)
      refuse("invalid-field", "the model has the parts 0 to " + std::to_string(part_count) + ", the last excluded",
             pointer);
    std::optional<std::string> role;
    if (!value.is_null()) {
      role = checked_text(value, max_name_bytes, pointer);
      if (std::find(part_role_names.begin(), part_role_names.end(), *role) == part_role_names.end())
        refuse("invalid-field", "\"" + *role + "\" is no role", pointer);
    }
    changes.emplace_back(part, std::move(role));
  }
  return changes;
}

http::Response full_model(Context& context, const store::ModelRecord& model) {
  auto response = json_response(200, represent(model, context.store.artefacts(model.id)));
  response.headers["ETag"] = model_etag(model);
  return response;
}

}  // namespace

http::Response list_models(Context& context, http::Request& request) {
  const auto limit = page_size(request);
  const auto after = request.query_value("after").value_or("");
  auto models = context.store.models(after, limit + 1);
  if (!models) refuse("invalid-argument", "there is no model to go on after", "?after");
  Json json = {{"models", Json::array()}, {"next", nullptr}};
  if (models->size() > limit) {
    models->resize(limit);
    json["next"] = models->back().id;
  }
  for (const auto& model : *models) json["models"].push_back(represent(model, context.store.artefacts(model.id)));
  return json_response(200, json);
}

http::Response get_model(Context& context, http::Request& request) {
  return http::apply_conditions(request, full_model(context, model_of(context, request)));
}

http::Response patch_model(Context& context, http::Request& request) {
  const auto model = model_of(context, request);
  check_if_match(request, model_etag(model));
  const auto body = body_object(request);
  refuse_unknown_members(body, {"name", "roles"});
  std::optional<std::string> name;
  if (body.contains("name")) name = checked_text(body["name"], max_name_bytes, "/name");
  std::vector<store::RoleChange> roles;
  if (body.contains("roles")) roles = role_changes(body["roles"], model.parts.size());
  if (!context.store.edit_model(model.id, name, roles, model.revision))
    refuse("conflict", "the model was changed by somebody else in the same moment: read it and try again");
  return full_model(context, model_of(context, request));
}

http::Response delete_model(Context& context, http::Request& request) {
  const auto model = model_of(context, request);
  check_if_match(request, model_etag(model));
  context.jobs.cancel_all_of(model.id);
  const std::unique_lock alone(context.blobs.references());
  const auto orphans = context.store.remove_model(model.id);
  if (!orphans) refuse("not-found", "there is no model " + model.id);
  for (const auto& hash : *orphans) context.blobs.remove(hash);
  http::Response response;
  response.status = 204;
  return response;
}

}  // namespace semblante::api

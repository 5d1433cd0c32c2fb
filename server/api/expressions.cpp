#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/expressions/contact.h"
#include "core/extract/set_file.h"
#include "protocol/cpp/rig_document.h"
#include "protocol/hash/sha256.h"
#include "server/api/common.h"
#include "server/api/generated/body_members.h"
#include "server/api/generated/handlers.h"
#include "server/api/mapped_file.h"
#include "server/api/sets.h"
#include "server/http/conditional.h"

namespace semblante::api {
namespace {

answer::Expression represent_built_in(const NamedSet& set) {
  return {.id = set.name,
          .name = set.name,
          .kind = to_string(set.kind),
          .built_in = true,
          .revision = 1,
          .created = std::nullopt,
          .updated = std::nullopt,
          .source = std::nullopt,
          .href = "/v1/expressions/" + set.name};
}

store::SetRecord own_set_of(Context& context, const http::Request& request) {
  const auto& id = request.params.at("expression");
  auto set = context.store.set(id);
  if (set) return std::move(*set);
  if (find_built_in(id)) refuse("conflict", "\"" + id + "\" is built in: it stays as it is");
  refuse("not-found", "there is no expression " + id);
}

/// The data of a model's rig that displacement sets depend on.
Rig rig_of(Context& context, const std::string& id) {
  const auto model = context.store.model(id);
  if (!model) refuse("invalid-argument", "there is no model " + id, "?model");
  const auto artefact = context.store.artefact(model->id, "rig.json");
  if (!artefact) refuse("conflict", "the model is not parametrized: its units are not known", "?model");
  const MappedFile file(context.blobs.whole(artefact->sha256, artefact->bytes));
  const auto document = read_rig(file.text());
  if (!document) refuse("internal", "rig.json cannot be read: " + document.error().message);
  Rig rig;
  rig.fapu = document->fapu;
  for (const auto& point : document->feature_points) rig.points.push_back({point.id, std::nullopt, point.position});
  return rig;
}

/// The set applied to one face: in model units, stopped where lips meet.
answer::Expression::OnModel on_model(const NamedSet& set, const std::string& model, const Rig& rig) {
  const auto worn = on_face(set.view(), rig.fapu, rig.points);
  answer::Members<std::string> skipped;
  std::vector<Displacement> marked;
  for (const Displacement& d : worn.displacements) {
    if (std::any_of(rig.points.begin(), rig.points.end(), [&](const FeaturePoint& p) { return p.id == d.point; }))
      marked.push_back(d);
    else
      skipped.emplace_back(to_string(d.point), "not marked");
  }
  for (const MissingUnit& missing : worn.skipped)
    skipped.emplace_back(to_string(missing.point),
                         std::string(fapu_unit_names[static_cast<std::size_t>(missing.unit)]) + " is not known");
  return {.model = model, .displacements = {displacements_to_json(marked).dump()}, .skipped = std::move(skipped)};
}

http::Response full_set(Context& context, const http::Request& request, const NamedSet& set, answer::Expression answer,
                        std::string etag) {
  answer.displacements = answer::JsonText{displacements_to_json(set.displacements).dump()};
  if (const auto model = request.query_value("model")) {
    answer.on_model = on_model(set, std::string(*model), rig_of(context, std::string(*model)));
    etag.clear();  // the answer depends on another resource too
  }
  auto response = json_response(200, answer);
  if (etag.empty()) etag = "\"sha256-" + sha256_hex(std::get<std::string>(response.body)) + "\"";
  response.headers["ETag"] = etag;
  return response;
}

}  // namespace

std::optional<NamedSet> find_built_in(std::string_view name) {
  for (const auto& [kind, library] :
       {std::pair{SetKind::viseme, viseme_library()}, std::pair{SetKind::expression, expression_library()}}) {
    for (const DisplacementSet& set : library) {
      if (set.name == name)
        return NamedSet{std::string(set.name), kind, {set.displacements.begin(), set.displacements.end()}};
    }
  }
  return std::nullopt;
}

NamedSet read_set(const store::SetRecord& record) {
  auto displacements = parse_set_displacements(record.displacements);
  if (!displacements) refuse("internal", "the expression cannot be read: " + displacements.error().message);
  return {record.name, parse_set_kind(record.kind).value_or(SetKind::expression), std::move(*displacements)};
}

NamedSet set_from_body(const http::Request& request) {
  const auto body = body_object(request);
  refuse_unknown_members(body, body_members::expression_edit);
  checked_text(body.value("name", JsonBody(nullptr)), 200, "/name");
  auto set = parse_displacement_set(request.body);
  if (!set) refuse("invalid-field", set.error().message, set.error().where);
  return std::move(*set);
}

http::Response new_set_response(const store::SetRecord& set, int status) {
  auto answer = represent(set);
  answer.displacements = answer::JsonText{set.displacements};
  auto response = json_response(status, answer);
  response.headers["ETag"] = set_etag(set);
  response.headers["Location"] = "/v1/expressions/" + set.id;
  return response;
}

http::Response get_expressions(Context& context, http::Request& request) {
  const auto limit = page_size(request);
  const auto after = request.query_value("after").value_or("");
  auto sets = context.store.sets(after, limit + 1);
  if (!sets) refuse("invalid-argument", "there is no expression with this id", "?after");
  answer::Expressions page{.visemes = {}, .expressions = {}, .sets = {}, .next = cut_to_page(*sets, limit)};
  for (const auto& set : viseme_library()) page.visemes.emplace_back(set.name);
  for (const auto& set : expression_library()) page.expressions.emplace_back(set.name);
  for (const auto& set : *sets) page.sets.push_back(represent(set));
  return json_response(200, page);
}

http::Response get_expression(Context& context, http::Request& request) {
  const auto& id = request.params.at("expression");
  if (const auto built_in = find_built_in(id))
    return http::apply_preconditions(
        request, full_set(context, request, *built_in, represent_built_in(*built_in), std::string()));
  const auto set = own_set_of(context, request);
  return http::apply_preconditions(request, full_set(context, request, read_set(set), represent(set), set_etag(set)));
}

http::Response put_expression(Context& context, http::Request& request) {
  auto record = own_set_of(context, request);
  check_if_match(request, set_etag(record));
  const NamedSet set = set_from_body(request);
  record.name = set.name;
  record.kind = std::string(to_string(set.kind));
  record.displacements = displacements_to_json(set.displacements).dump();
  if (!context.store.put_set(record))
    refuse("conflict", "another request changed the expression at the same time: read it and try again");
  const auto now = own_set_of(context, request);
  return full_set(context, request, read_set(now), represent(now), set_etag(now));
}

http::Response delete_expression(Context& context, http::Request& request) {
  const auto set = own_set_of(context, request);
  check_if_match(request, set_etag(set));
  if (!context.pending.with_reserve([&] { return context.store.remove_set(set.id); }))
    refuse("not-found", "there is no expression " + set.id);
  http::Response response;
  response.status = 204;
  return response;
}

}  // namespace semblante::api

#include <algorithm>
#include <filesystem>
#include <shared_mutex>

#include <nlohmann/json.hpp>

#include "core/extract/extract.h"
#include "core/extract/set_file.h"
#include "core/import/feature_points_file.h"
#include "core/import/import.h"
#include "protocol/hash/sha256.h"
#include "server/api/common.h"
#include "server/api/generated/body_members.h"
#include "server/api/generated/handlers.h"
#include "server/api/mapped_file.h"
#include "server/api/quota.h"
#include "server/api/sets.h"
#include "server/api/storage_problems.h"
#include "server/http/media_type.h"
#include "server/http/multipart.h"

namespace semblante::api {
namespace {

/// The content of a request for an extraction, independent of its media type.
struct ExampleRequest {
  jobs::ExtractJob wish;
  std::string model;
  std::string_view expression, neutral;  ///< bytes of files; point into the request's body
};

std::string text_or_empty(const JsonBody& options, const char* key) {
  if (!options.contains(key)) return {};
  return checked_text(options[key], max_name_bytes, std::string("/") + key);
}

/// Reads the members that all sources have.
ExampleRequest read_options(const JsonBody& options) {
  refuse_unknown_members(options, body_members::extraction_options);
  ExampleRequest example;
  example.wish.name = text_or_empty(options, "name");
  if (options.contains("kind")) {
    if (!options["kind"].is_string() || !parse_set_kind(options["kind"].get<std::string>()))
      refuse("invalid-field", "it must be \"viseme\" or \"expression\"", "/kind");
    example.wish.kind = options["kind"].get<std::string>();
  }
  if (options.contains("align")) {
    if (!options["align"].is_boolean()) refuse("invalid-field", "it must be true or false", "/align");
    example.wish.align = options["align"].get<bool>();
  }
  example.wish.least = number_or(options, "least", 1.0, 0.0, most_set_units);
  example.wish.strength = number_or(options, "strength", 1.0, least_strength, most_strength);
  example.model = text_or_empty(options, "model");
  example.wish.target = text_or_empty(options, "target");
  example.wish.from = text_or_empty(options, "from");
  return example;
}

std::vector<store::FeaturePointRecord> read_points(std::string_view text) {
  const auto file = parse_feature_points(text);
  if (!file) refuse("invalid-feature-point", file.error().message, "/feature_points" + file.error().where);
  if (file->to_mpeg4_axes && *file->to_mpeg4_axes != glm::dmat3(1.0))
    refuse("invalid-field", "only heads that stand in MPEG-4's axes, or whose points show how they stand, are taken",
           "/feature_points/to_mpeg4_axes");
  std::vector<store::FeaturePointRecord> points;
  for (const MarkedPoint& point : file->points) {
    store::FeaturePointRecord record{to_string(point.id), point.vertex, std::nullopt};
    if (point.position) record.position = {point.position->x, point.position->y, point.position->z};
    points.push_back(std::move(record));
  }
  return points;
}

/// Checks that bytes can be a mesh; only a worker parses them.
void check_file(std::string_view bytes, const std::string& file_name, const std::string& pointer) {
  if (bytes.empty()) refuse("empty-model", "the file is empty", pointer);
  const auto format = format_of({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, file_name);
  if (!format) refuse("unsupported-model", format.error().message, pointer, format.error().advice);
}

ExampleRequest read_form(std::string_view body, std::string_view boundary) {
  const auto parts = http::parse_multipart(body, boundary);
  if (!parts) refuse("malformed-request", "the form cannot be read: " + parts.error().message);
  const auto find = [&](std::string_view name) -> const http::FormPart* {
    const auto found = std::find_if(parts->begin(), parts->end(), [&](const auto& part) { return part.name == name; });
    return found == parts->end() ? nullptr : &*found;
  };
  http::Request options;
  if (const auto* part = find("options")) options.body = std::string(part->content);
  ExampleRequest example = read_options(body_object(options));
  const auto* expression = find("expression");
  if (expression == nullptr) refuse("invalid-field", "the form has no part \"expression\"", "/expression");
  if (!example.wish.target.empty() || !example.wish.from.empty())
    refuse("invalid-field", "a file of the expression is sent: it takes the place of morph targets", "/target");
  example.expression = expression->content;
  example.wish.expression_file = clean_file_name(expression->file_name);
  check_file(example.expression, example.wish.expression_file, "/expression");
  const auto* neutral = find("neutral");
  if ((neutral == nullptr) == example.model.empty())
    refuse("invalid-field", "send a part \"neutral\" or name a stored model, one of the two", "/neutral");
  if (neutral == nullptr) return example;
  example.neutral = neutral->content;
  example.wish.neutral_file = clean_file_name(neutral->file_name);
  check_file(example.neutral, example.wish.neutral_file, "/neutral");
  const auto* points = find("feature_points");
  if (points == nullptr) refuse("missing-feature-points", "the form has no part \"feature_points\"", "/feature_points");
  example.wish.points = read_points(points->content);
  return example;
}

/// Checks a stored model without parsing it.
void check_model(Context& context, const ExampleRequest& example) {
  const auto model = context.store.model(example.model);
  if (!model) refuse("invalid-field", "there is no model of this id", "/model");
  refuse_unless_imported(*model);
  if (model->feature_point_count == 0)
    refuse("missing-feature-points", "no feature point is marked on this model", "/model");
  constexpr std::size_t most_listed = 512;  // an import stores no more
  if (model->morph_targets.size() >= most_listed) return;
  std::string names;
  for (const auto& target : model->morph_targets) names.append(names.empty() ? "" : ", ").append(target.name);
  for (const auto& [field, name] : {std::pair{"/target", example.wish.target}, std::pair{"/from", example.wish.from}}) {
    if (name.empty()) continue;
    if (std::none_of(model->morph_targets.begin(), model->morph_targets.end(),
                     [wanted = name](const auto& target) { return target.name == wanted; }))
      refuse("invalid-field",
             "the model has no morph target of this name; " + (names.empty() ? "it has none" : "it has " + names),
             field);
  }
}

std::string default_name(const jobs::ExtractJob& wish) {
  auto name = wish.target.empty() ? std::filesystem::path(wish.expression_file).stem().string() : wish.target;
  return name.empty() ? "Untitled" : name;
}

std::string keep(Context& context, std::string_view bytes) {
  if (bytes.empty()) return {};
  auto blob = context.blobs.put(bytes);
  if (!blob) refuse_unkept(blob.error());
  return blob->sha256;
}

http::Response earlier(Context& context, const std::string& id) {
  if (const auto job = context.jobs.find(id)) return accepted(*job);
  if (const auto set = context.store.set(id)) return new_set_response(*set, 201);
  refuse("conflict", "what this Idempotency-Key created has been removed");
}

void refuse_too_many(Context& context) {
  const auto most = context.config.limits.max_expressions;
  if (context.store.set_count() >= most)
    refuse("limit-exceeded", "the server has reached its limit of " + std::to_string(most) + " expressions");
}

http::Response create_by_hand(Context& context, http::Request& request) {
  const NamedSet set = set_from_body(request);
  auto check = check_idempotency(context, request, sha256_hex(request.body));
  if (check.earlier) return earlier(context, *check.earlier);
  refuse_too_many(context);
  store::SetRecord record;
  record.id = store::random_id();
  record.name = set.name;
  record.kind = std::string(to_string(set.kind));
  record.created = record.updated = store::timestamp_now();
  record.displacements = displacements_to_json(set.displacements).dump();
  record.owner = origin_of(request).owner;
  const auto turn = take_quota(context, request, {.bytes = record.displacements.size(), .sets = 1});
  if (check.record) check.record->resource = record.id;
  context.store.create_set(record, check.record);
  return new_set_response(record, 201);
}

http::Response create_by_example(Context& context, http::Request& request, ExampleRequest example,
                                 const std::string& body_hash) {
  auto check = check_idempotency(context, request, body_hash);
  if (check.earlier) return earlier(context, *check.earlier);
  if (!example.model.empty()) check_model(context, example);
  refuse_too_many(context);
  refuse_unless_room(context.jobs);
  // The files are kept until the job has ended.
  const auto turn = take_quota(context, request,
                               {.bytes = example.expression.size() + example.neutral.size() + 1, .sets = 1, .jobs = 1});
  jobs::ExtractJob wish = std::move(example.wish);
  if (wish.name.empty()) wish.name = default_name(wish);
  store::JobRecord job;
  {
    // Protects the files from removal until the job that refers to them is stored.
    const std::shared_lock shared(context.blobs.references());
    wish.expression_sha256 = keep(context, example.expression);
    wish.neutral_sha256 = keep(context, example.neutral);
    job = jobs::new_record(wish, example.model, origin_of(request));
    if (check.record) check.record->resource = job.id;
    context.store.create_job(job, wish.files(), check.record);
  }
  context.jobs.enqueue(job);
  return accepted(job);
}

}  // namespace

http::Response create_expression(Context& context, http::Request& request) {
  if (request.body_file) {
    const MappedFile mapped(request.body_file->path());
    const auto boundary = http::parameter(request.header("Content-Type").value_or(""), "boundary");
    const ExampleRequest example = read_form(mapped.text(), boundary);
    // The fingerprint is not that of the raw body, because a retry has another boundary.
    const auto& wish = example.wish;
    std::string whole = sha256_hex(example.expression) + sha256_hex(example.neutral) + wish.expression_file + "\n" +
                        wish.neutral_file + "\n" + example.model + "\n" + wish.name + "\n" + wish.kind;
    whole.append(Json({wish.align, wish.least, wish.strength}).dump());
    for (const auto& point : wish.points) {
      whole.append(point.id);
      if (point.vertex) whole.append(std::to_string(*point.vertex));
      if (point.position) whole.append(Json(*point.position).dump());
    }
    return create_by_example(context, request, example, sha256_hex(whole));
  }
  const auto body = body_object(request);
  if (body.contains("displacements")) return create_by_hand(context, request);
  ExampleRequest example = read_options(body);
  if (example.model.empty())
    refuse("invalid-field", "give \"displacements\", or a \"model\" and its morph \"target\"", "/model");
  if (example.wish.target.empty())
    refuse("invalid-field", "name a morph target of the model, or send the file of the expression in a form",
           "/target");
  return create_by_example(context, request, std::move(example), sha256_hex(request.body));
}

}  // namespace semblante::api

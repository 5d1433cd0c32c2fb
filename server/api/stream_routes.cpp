#include <algorithm>

#include <nlohmann/json.hpp>

#include "protocol/cpp/json_codec.h"
#include "server/api/common.h"
#include "server/api/routes.h"
#include "server/hash/sha256.h"

namespace semblante::api {
namespace {

constexpr std::size_t max_slug_bytes = 64;
constexpr std::size_t max_title_bytes = 200;
constexpr std::uint32_t usual_batch_interval = 100;  ///< ms
constexpr int most_batch_interval = 1000;
/// Seconds: in three there is room for the 1024 frames of the longest message.
constexpr unsigned throttled_retry_after = 3;

std::string checked_slug(const JsonBody& value) {
  auto slug = checked_text(value, max_slug_bytes, "/name");
  const auto good = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_'; };
  if (!std::all_of(slug.begin(), slug.end(), good) || slug.front() == '-')
    refuse("invalid-field", "it takes lower-case letters, digits, - and _", "/name");
  return slug;
}

double checked_share(const JsonBody& value) {
  const double share = value.is_number() ? value.get<double>() : -1.0;
  if (!(share >= 0.0 && share <= 1.0)) refuse("invalid-field", "must be a number from 0 to 1", "/viseme_share");
  return share;
}

std::uint32_t checked_interval(const JsonBody& value) {
  const double interval = value.is_number_integer() ? value.get<double>() : -1.0;
  if (!(interval >= 0.0 && interval <= most_batch_interval))
    refuse("invalid-field", "must be a whole number from 0 to " + std::to_string(most_batch_interval),
           "/batch_interval");
  return static_cast<std::uint32_t>(interval);
}

double checked_scale(const JsonBody& value) {
  const double scale = value.is_number() ? value.get<double>() : 0.0;
  if (!is_quantizer_scale(scale)) refuse("invalid-field", "must be 1, 0.5, 0.25 or 0.125", "/quantizer_scale");
  return scale;
}

streams::StreamInfo info_of(Context& context, const http::Request& request) {
  const auto& id = request.params.at("stream");
  auto info = context.hub.info(id);
  if (!info) refuse("not-found", "there is no stream " + id);
  return std::move(*info);
}

http::Response created(const streams::StreamInfo& info) {
  auto response = json_response(201, represent(info));
  response.headers["Location"] = "/v1/streams/" + info.id;
  return response;
}

}  // namespace

http::Response list_streams(Context& context, http::Request&) {
  Json json = {{"streams", Json::array()}};
  for (const auto& stream : context.hub.list()) json["streams"].push_back(represent(stream));
  return json_response(200, json);
}

http::Response create_stream(Context& context, http::Request& request) {
  const auto body = body_object(request);
  refuse_unknown_members(body, {"name", "title", "model", "viseme_share", "batch_interval", "quantizer_scale"});
  streams::StreamInfo info;
  info.id = body.contains("name") ? checked_slug(body["name"]) : store::random_id();
  info.title = body.contains("title") ? checked_text(body["title"], max_title_bytes, "/title") : info.id;
  if (body.contains("model") && !body["model"].is_null()) {
    info.model = checked_text(body["model"], max_slug_bytes, "/model");
    if (!context.store.model(info.model)) refuse("invalid-field", "there is no model " + info.model, "/model");
  }
  if (body.contains("viseme_share") && !body["viseme_share"].is_null())
    info.viseme_share = checked_share(body["viseme_share"]);
  info.batch_interval = checked_interval(body.value("batch_interval", JsonBody(usual_batch_interval)));
  info.quantizer_scale = checked_scale(body.value("quantizer_scale", JsonBody(1.0)));
  info.created = store::timestamp_now();
  info.source = "none";

  auto check = check_idempotency(context, request, sha256_hex(request.body));
  if (check.earlier) {
    if (const auto earlier = context.hub.info(*check.earlier)) return created(*earlier);
    refuse("conflict", "what this key made has been removed");
  }
  if (context.hub.list().size() >= context.config.limits.max_streams)
    refuse("limit-exceeded", "the server holds its " + std::to_string(context.config.limits.max_streams) + " streams");
  if (check.record) check.record->resource = info.id;
  // Durable before it is there for others, so that a stream somebody saw is never forgotten.
  if (context.hub.info(info.id) ||
      !context.store.create_stream(
          {info.id, info.title, info.model, info.created, info.viseme_share, info.batch_interval, info.quantizer_scale},
          check.record))
    refuse("conflict", "there is a stream " + info.id + " already", "/name");
  context.hub.open(info);
  return created(context.hub.info(info.id).value_or(info));
}

http::Response get_stream(Context& context, http::Request& request) {
  return json_response(200, represent(info_of(context, request)));
}

http::Response delete_stream(Context& context, http::Request& request) {
  const auto info = info_of(context, request);
  if (info.source != "none") refuse("conflict", "the " + info.source + " stream is the server's own");
  context.pending.with_reserve([&] { return context.store.remove_stream(info.id); });
  context.hub.close(info.id, EndReason::deleted);
  http::Response response;
  response.status = 204;
  return response;
}

http::Response post_frames(Context& context, http::Request& request) {
  const auto info = info_of(context, request);
  std::size_t clamped_coefficients = 0;
  auto frames = decode_json_frames(request.body, scaled_quantizers(info.quantizer_scale), &clamped_coefficients);
  if (!frames) {
    const auto& error = frames.error();
    refuse(error.code == ErrorCode::malformed && error.where.empty() ? "malformed-request" : "invalid-frame",
           error.message, error.where);
  }
  const auto receipt = context.hub.publish(info.id, *frames);
  if (!receipt) {
    const auto& error = receipt.error();
    if (error.code == ErrorCode::missing) refuse("not-found", error.message);
    // So long until there is room for as many, whether it was the rate or the frames that are ahead.
    if (error.code == ErrorCode::too_large) refuse_for_now(error.message, throttled_retry_after);
    refuse(error.code == ErrorCode::mismatch ? "conflict" : "invalid-frame", error.message, error.where);
  }
  return json_response(202, {{"accepted", receipt->accepted},
                             {"sequence", receipt->sequence},
                             {"clamped", receipt->clamped + clamped_coefficients}});
}

}  // namespace semblante::api

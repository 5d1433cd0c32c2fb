#include <algorithm>
#include <vector>

#include <nlohmann/json.hpp>

#include "protocol/cpp/json_codec.h"
#include "protocol/hash/sha256.h"
#include "server/api/common.h"
#include "server/api/generated/body_members.h"
#include "server/api/generated/handlers.h"
#include "server/api/quota.h"
#include "server/settings/stream_settings.h"

namespace semblante::api {
namespace {

constexpr std::size_t max_slug_bytes = 64;
/// Seconds after which the flood guard accepts the longest message (1024 frames).
constexpr unsigned throttled_retry_after = 3;

std::string checked_slug(const JsonBody& value) {
  auto slug = checked_text(value, max_slug_bytes, "/name");
  const auto good = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_'; };
  if (!std::all_of(slug.begin(), slug.end(), good) || slug.front() == '-')
    refuse("invalid-field", "it takes lower-case letters, digits, - and _", "/name");
  return slug;
}

/// Reads the settings in the body of a request that creates the stream `id`.
settings::StreamSettings checked_settings(Context& context, const JsonBody& body, const std::string& id) {
  refuse_unknown_members(body, body_members::create_stream);
  auto read = settings::read_stream_settings(body, id);
  if (!read) refuse("invalid-field", read.error().message, read.error().where);
  if (!read->model.empty() && !context.store.model(read->model))
    refuse("invalid-field", "there is no model " + read->model, "/model");
  return std::move(*read);
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

http::Response list_streams(Context& context, http::Request& request) {
  const auto limit = page_size(request);
  auto list = context.hub.list();
  if (const auto after = request.query_value("after").value_or(""); !after.empty()) {
    const auto last = std::ranges::find(list, after, &streams::StreamInfo::id);
    if (last == list.end()) refuse("invalid-argument", "there is no stream with this id", "?after");
    list.erase(list.begin(), std::next(last));
  }
  answer::Streams page{.streams = {}, .next = cut_to_page(list, limit)};
  for (const auto& stream : list) page.streams.push_back(represent(stream));
  return json_response(200, page);
}

http::Response create_stream(Context& context, http::Request& request) {
  const auto body = body_object(request);
  streams::StreamInfo info;
  info.id = body.contains("name") ? checked_slug(body["name"]) : store::random_id();
  info.settings = checked_settings(context, body, info.id);
  info.created = store::timestamp_now();
  info.source = "none";

  auto check = check_idempotency(context, request, sha256_hex(request.body));
  if (check.earlier) {
    if (const auto earlier = context.hub.info(*check.earlier)) return created(*earlier);
    refuse("conflict", "what this Idempotency-Key created has been removed");
  }
  if (context.hub.list().size() >= context.config.limits.max_streams)
    refuse("limit-exceeded",
           "the server has reached its limit of " + std::to_string(context.config.limits.max_streams) + " streams");
  const auto change = take_stream_turn(context, info.id);
  const auto turn = take_quota(context, request, {.streams = 1});
  if (check.record) check.record->resource = info.id;
  // Stored before it is opened, so that a stream that a client has seen survives a crash.
  if (context.hub.info(info.id) ||
      !context.store.create_stream({info.id, info.created, info.settings, origin_of(request).owner}, check.record))
    refuse("conflict", "there is a stream " + info.id + " already", "/name");
  context.hub.open(info);
  return created(context.hub.info(info.id).value_or(info));
}

http::Response get_stream(Context& context, http::Request& request) {
  return json_response(200, represent(info_of(context, request)));
}

http::Response delete_stream(Context& context, http::Request& request) {
  const auto change = take_stream_turn(context, request.params.at("stream"));
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
  auto frames =
      decode_json_frames(request.body, scaled_quantizers(info.settings.quantizer_scale), &clamped_coefficients);
  if (!frames) {
    const auto& error = frames.error();
    refuse(error.code == ErrorCode::malformed && error.where.empty() ? "malformed-request" : "invalid-frame",
           error.message, error.where);
  }
  const auto receipt = context.hub.publish(info.id, *frames);
  if (!receipt) {
    const auto& error = receipt.error();
    if (error.code == ErrorCode::missing) refuse("not-found", error.message);
    // The same delay for both causes: the rate, or frames too far ahead of the clock.
    if (error.code == ErrorCode::too_large) refuse_for_now(error.message, throttled_retry_after);
    refuse(error.code == ErrorCode::mismatch ? "conflict" : "invalid-frame", error.message, error.where);
  }
  return json_response(202, answer::FramesReceipt{.accepted = receipt->accepted,
                                                  .sequence = receipt->sequence,
                                                  .clamped = receipt->clamped + clamped_coefficients});
}

}  // namespace semblante::api

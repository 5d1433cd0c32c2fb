#include <algorithm>
#include <charconv>

#include <nlohmann/json.hpp>

#include "protocol/cpp/quantizers.h"
#include "protocol/hash/sha256.h"
#include "server/api/authorization.h"
#include "server/api/common.h"
#include "server/api/generated/body_members.h"
#include "server/api/generated/handlers.h"
#include "server/api/play_options.h"
#include "server/api/quota.h"
#include "server/api/recordings_common.h"
#include "server/api/storage_problems.h"
#include "server/recordings/recording_source.h"

namespace semblante::api {
namespace {

using recordings::RecordingStatus;

std::optional<std::uint64_t> checked_duration(const JsonBody& value) {
  const double ms = value.is_number() ? value.get<double>() : 0.0;
  if (!(ms >= 1.0 && ms <= static_cast<double>(recordings::max_recording_ms)))
    refuse("invalid-field", "must be a number of milliseconds from 1 to 86400000", "/max_duration");
  return static_cast<std::uint64_t>(ms);
}

http::Response created(const RecordingStatus& recording) {
  auto response = json_response(201, represent(recording));
  response.headers["Location"] = "/v1/recordings/" + recording.record.id;
  return response;
}

http::Response list_of(Context& context, const http::Request& request, const std::string& stream) {
  const auto limit = page_size(request);
  auto records = context.store.recordings(stream, request.query_value("after").value_or(""), limit + 1);
  if (!records) refuse("invalid-argument", "there is no such recording", "?after");
  answer::Recordings page{.recordings = {}, .next = cut_to_page(*records, limit)};
  for (auto& record : *records)
    page.recordings.push_back(represent(context.recorder->with_progress(std::move(record))));
  return json_response(200, page);
}

}  // namespace

RecordingStatus recording_of(Context& context, const http::Request& request) {
  const auto& id = request.params.at("recording");
  auto recording = context.recorder->find(id);
  if (!recording) refuse("not-found", "there is no recording " + id);
  return std::move(*recording);
}

void refuse_damaged(const Error& error) {
  refuse("conflict", "the recording is damaged: " + (error.where.empty() ? "" : error.where + ": ") + error.message);
}

std::shared_ptr<const recordings::ByteSource> bytes_of(Context& context, const RecordingStatus& recording) {
  const auto& record = recording.record;
  // While it runs: only the durable part.
  const bool runs = record.state == store::RecordingState::recording;
  auto bytes = recordings::open_bytes(context.recorder->path_of(record.id), runs ? record.bytes : UINT64_MAX);
  // Its `where` is a path of this machine: for the log.
  if (!bytes && bytes.error().code == ErrorCode::missing)
    refuse_damaged({ErrorCode::missing, "", "its file is missing"});
  if (!bytes) refuse_unkept(bytes.error());
  return std::move(*bytes);
}

std::shared_ptr<const recordings::RecordingReader> read_recording(Context& context, const RecordingStatus& recording) {
  auto reader = recordings::RecordingReader::open(bytes_of(context, recording), recordings::Check::heads);
  if (!reader) refuse_damaged(reader.error());
  return std::make_shared<const recordings::RecordingReader>(std::move(*reader));
}

std::uint32_t whole_number(const http::Request& request, const std::string& name, std::uint32_t otherwise,
                           std::uint32_t most) {
  const auto text = request.query_value(name);
  if (!text) return otherwise;
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
  if (error != std::errc() || end != text->data() + text->size() || value > most)
    refuse("invalid-argument", "must be a whole number from 0 to " + std::to_string(most), "?" + name);
  return value;
}

answer::Recording represent(const RecordingStatus& recording) {
  const auto& r = recording.record;
  const bool runs = r.state == store::RecordingState::recording;
  const std::string self = "/v1/recordings/" + r.id;
  std::optional<answer::Recording::Ended> ended;
  if (!r.ended.empty()) ended = r.ended;
  return {.id = r.id,
          .stream = r.stream,
          .name = r.name,
          .model = text_or_null(r.model),
          .created = r.created,
          .state = to_string(r.state),
          .ended = std::move(ended),
          .duration = r.duration,
          .durable_until = r.frames > 0 ? std::optional(r.duration) : std::nullopt,
          .frames = r.frames,
          .lost = std::max(r.lost, recording.dropped),
          .bytes = r.bytes,
          .epoch = r.epoch,
          .media_time = r.frames > 0 ? std::optional(r.media_time) : std::nullopt,
          .max_duration = r.max_duration,
          .sound = r.sound_packets ? std::optional(*r.sound_packets > 0) : std::nullopt,
          .links = {.self = self,
                    .stop = runs ? std::optional(self + "/stop") : std::nullopt,
                    .content = self + "/content",
                    .frames = self + "/frames"}};
}

http::Response create_recording(Context& context, http::Request& request) {
  const auto& stream = request.params.at("stream");
  const auto header = [&] {
    auto found = context.hub.header(stream);
    if (!found) refuse("not-found", "there is no stream " + stream);
    return std::move(*found);
  };
  recordings::RecordingStart start;
  start.header = header();
  const auto body = body_object(request);
  refuse_unknown_members(body, body_members::create_recording);
  if (body.contains("name")) start.name = checked_text(body["name"], max_name_bytes, "/name");
  if (body.contains("max_duration") && !body["max_duration"].is_null())
    start.max_duration = checked_duration(body["max_duration"]);
  auto check = check_idempotency(context, request, sha256_hex(request.body));
  if (check.earlier) {
    if (const auto earlier = context.recorder->find(*check.earlier)) return created(*earlier);
    refuse("conflict", "what this Idempotency-Key created has been removed");
  }
  // The end of a stream ends the recordings that it has: none must begin meanwhile.
  const auto change = take_stream_turn(context, stream);
  start.header = header();
  if (start.name.empty()) start.name = start.header.title;
  const auto turn = take_quota(context, request, {.bytes = 1, .recordings = 1});
  start.owner = origin_of(request).owner;
  start.has_room = recording_room(context, request);
  const auto record = context.recorder->start(std::move(start), std::move(check.record));
  if (!record) {
    if (record.error().code == ErrorCode::io) refuse_unkept(record.error());
    refuse("limit-exceeded", record.error().message);
  }
  return created({*record, 0});
}

http::Response list_recordings(Context& context, http::Request& request) { return list_of(context, request, ""); }

http::Response list_stream_recordings(Context& context, http::Request& request) {
  const auto& stream = request.params.at("stream");
  // Recordings outlive their stream.
  if (!context.hub.info(stream) && !context.store.newest_recording(stream))
    refuse("not-found", "there is no stream " + stream);
  return list_of(context, request, stream);
}

http::Response get_recording(Context& context, http::Request& request) {
  return json_response(200, represent(recording_of(context, request)));
}

http::Response stop_recording(Context& context, http::Request& request) {
  const auto& id = request.params.at("recording");
  auto record = context.recorder->stop(id);
  if (!record) refuse("not-found", "there is no recording " + id);
  if (record->state == store::RecordingState::recording) refuse_pending(context, "the recording has ended");
  return json_response(200, represent(RecordingStatus{std::move(*record), 0}));
}

http::Response delete_recording(Context& context, http::Request& request) {
  const auto& id = request.params.at("recording");
  if (!context.recorder->remove(id)) refuse("not-found", "there is no recording " + id);
  http::Response response;
  response.status = 204;
  return response;
}

http::Response play_recording(Context& context, http::Request& request) {
  const auto& stream = request.params.at("stream");
  const auto info = context.hub.info(stream);
  if (!info) refuse("not-found", "there is no stream " + stream);
  const auto body = body_object(request);
  refuse_unknown_members(body, body_members::play_recording);
  if (!body.contains("recording"))
    refuse("invalid-field", "the id of the recording to be played is missing", "/recording");
  const auto id = checked_text(body["recording"], max_name_bytes, "/recording");
  refuse_foreign_recording(context, request, id);
  const auto recording = context.recorder->find(id);
  if (!recording) refuse("invalid-field", "there is no recording " + id, "/recording");
  streams::PlayOptions options;
  options.loop = flag_member(body, "loop");
  options.take_over = flag_member(body, "take_over");
  if (body.contains("from")) {
    options.from = body["from"].is_number() ? body["from"].get<double>() : -1.0;
    if (!(options.from >= 0.0 && options.from <= static_cast<double>(recording->record.duration)))
      refuse("invalid-field", "must be a number of milliseconds from 0 to the recording's duration", "/from");
  }
  const auto source = recordings::make_recording_source(bytes_of(context, *recording), recording->record.name,
                                                        scaled_quantizers(info->settings.quantizer_scale));
  if (!source) {
    if (source.error().code == ErrorCode::empty) refuse("conflict", "there is no frame in the recording yet");
    refuse_damaged(source.error());
  }
  const auto& record = recording->record;
  if (record.duration > 0)
    options.rate = std::clamp(1000.0 * static_cast<double>(record.frames - 1) / static_cast<double>(record.duration),
                              streams::least_play_rate, streams::most_play_rate);
  return play_into(context, stream, *source, options);
}

}  // namespace semblante::api

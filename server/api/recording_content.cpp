#include <algorithm>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/import/model_formats.h"
#include "protocol/cpp/json_codec.h"
#include "protocol/cpp/quantizers.h"
#include "server/api/export_file.h"
#include "server/api/generated/handlers.h"
#include "server/api/model_clip.h"
#include "server/api/recordings_common.h"
#include "server/api/storage_problems.h"
#include "server/http/conditional.h"
#include "server/recordings/recording_export.h"

namespace semblante::api {
namespace {

using recordings::Cut;
using recordings::RecordingStatus;
using SharedReader = std::shared_ptr<const recordings::RecordingReader>;

constexpr std::uint32_t max_ms = static_cast<std::uint32_t>(recordings::max_recording_ms);
constexpr std::uint32_t default_frames = 200;
constexpr std::uint32_t most_frames = 1000;

struct Format {
  std::string_view name, extension, media_type;
};
constexpr auto formats = std::to_array<Format>({{"performance", "json", "application/json"},
                                                {"fap", "fap", "text/plain"},
                                                {"arkit-csv", "csv", "text/csv"},
                                                {"frames-json", "json", "application/json"},
                                                {"glb", "glb", glb_media_type},
                                                {"opus", "opus", "audio/ogg"},
                                                {"recording", "srec", "application/octet-stream"}});

const Format& format_of(const http::Request& request) {
  const auto name = request.query_value("format").value_or(formats.front().name);
  const auto* const found =
      std::find_if(formats.begin(), formats.end(), [&](const Format& f) { return f.name == name; });
  if (found != formats.end()) return *found;
  std::string names;
  for (const auto& format : formats) names.append(names.empty() ? "" : ", ").append(format.name);
  refuse("invalid-argument", "must be one of " + names, "?format");
}

[[noreturn]] void refuse_export(const Error& error) {
  if (error.code == ErrorCode::too_large) refuse("content-too-large", error.message);
  if (error.code == ErrorCode::empty) refuse("conflict", error.message);
  refuse_damaged(error);
}

/// Exports that are written chunk by chunk go through a temporary file, so that a long recording takes no memory, and a
/// fault in its middle gives an error answer instead of a truncated file.
template <class Write>
http::Body through_a_file(Context& context, Write write) {
  ExportFile file(context.blobs.temporary(), context.recorder->limits().disk_reserve);
  const auto written = write(file.stream());
  file.check();
  if (!written) refuse_export(written.error());
  return file.finish();
}

http::Body clip_of(Context& context, const http::Request& request, const RecordingStatus& recording,
                   const SharedReader& reader, const Cut& cut) {
  const std::string id(request.query_value("model").value_or(recording.record.model));
  if (id.empty()) refuse("conflict", "the stream had no model: give ?model", "?model");
  const auto model = context.store.model(id);
  if (!model) refuse("not-found", "there is no model " + id, "?model");
  const auto frames = recordings::gather(reader, cut, max_clip_memory_frames);
  if (!frames) refuse_export(frames.error());
  ClipOptions options;
  options.name = recording.record.name;
  if (const auto share = reader->header().viseme_share) options.viseme_share = static_cast<float>(*share);
  return clip_of_model(context, *model, 0, *frames, options, "?model");
}

http::Response content_of(Context& context, const http::Request& request, const RecordingStatus& recording) {
  const auto& format = format_of(request);
  Cut cut;
  cut.from = whole_number(request, "from", 0, max_ms);
  cut.to = whole_number(request, "to", max_ms, max_ms);
  if (cut.to < cut.from) refuse("invalid-argument", "ends before it begins", "?to");
  const bool by_rate = format.name != "performance" && format.name != "opus" && format.name != "recording";
  if (request.query_value("rate")) {
    if (!by_rate) refuse("invalid-argument", "a " + std::string(format.name) + " has no rate", "?rate");
    cut.rate = whole_number(request, "rate", 0, 1000);
    if (cut.rate == 0.0) refuse("invalid-argument", "must be a whole number from 1 to 1000", "?rate");
  }
  http::Response response;
  const auto& record = recording.record;
  response.headers["Content-Type"] = std::string(format.media_type);
  response.headers["Cache-Control"] = "no-cache";
  response.headers["Content-Disposition"] =
      "attachment; filename=\"" + record.id + "." + std::string(format.extension) + "\"";
  if (format.name == "recording") {
    if (request.query_value("from") || request.query_value("to"))
      refuse("invalid-argument", "the file is whole or by Range", request.query_value("from") ? "?from" : "?to");
    const auto bytes = bytes_of(context, recording);
    response.headers["ETag"] = "\"" + record.id + "-" + std::to_string(bytes->size()) + "\"";
    response.body = http::FileBody{context.recorder->path_of(record.id), 0, bytes->size()};
    return http::apply_conditions(request, std::move(response));
  }
  const auto slot = export_slot(context);
  const auto reader = read_recording(context, recording);
  const auto text = [](Result<std::string> made) {
    if (!made) refuse_export(made.error());
    return std::move(*made);
  };
  if (format.name == "performance")
    response.body = text(export_performance(reader, cut, record.name));
  else if (format.name == "fap")
    response.body = text(export_fap(reader, cut, record.id));
  else if (format.name == "glb")
    response.body = clip_of(context, request, recording, reader, cut);
  else if (format.name == "opus")
    response.body = through_a_file(context, [&](std::ostream& to) { return export_sound(reader, cut, to); });
  else if (format.name == "arkit-csv")
    response.body = through_a_file(context, [&](std::ostream& to) { return export_arkit_csv(reader, cut, to); });
  else
    response.body = through_a_file(context, [&](std::ostream& to) { return export_frames(reader, cut, to); });
  return response;
}

answer::RecordedFrame represent_frame(const recordings::RecordingReader& reader,
                                      const recordings::RecordingFrame& frame) {
  const auto time = static_cast<std::uint32_t>(frame.media_time - reader.begin());
  return {.face_frame = {encode_json_value({time, to_values(frame.state, quantizers_of(reader.header()))})},
          .time = time,
          .sequence = frame.sequence,
          .media_time = frame.media_time};
}

}  // namespace

http::Response get_recording_content(Context& context, http::Request& request) {
  return content_of(context, request, recording_of(context, request));
}

http::Response get_newest_recording(Context& context, http::Request& request) {
  const auto& stream = request.params.at("stream");
  auto record = context.store.newest_recording(stream);
  if (!record) refuse("not-found", "there is no recording of a stream " + stream);
  const auto recording = context.recorder->with_progress(std::move(*record));
  auto response = content_of(context, request, recording);
  response.headers["Content-Location"] = "/v1/recordings/" + recording.record.id + "/content";
  return response;
}

http::Response get_recording_frames(Context& context, http::Request& request) {
  const auto recording = recording_of(context, request);
  const auto reader = read_recording(context, recording);
  if (request.query_value("at")) {
    for (const char* name : {"from", "to", "after", "limit"})
      if (request.query_value(name)) refuse("invalid-argument", "is not for ?at", std::string("?") + name);
    const auto frame = reader->at(whole_number(request, "at", 0, max_ms));
    if (!frame) refuse_damaged(frame.error());
    if (!*frame) refuse("conflict", "there is no frame in the recording yet");
    return json_response(200,
                         answer::RecordedFrames{.frames = {represent_frame(*reader, **frame)}, .next = std::nullopt});
  }
  const auto from = whole_number(request, "from", 0, max_ms);
  const auto to = whole_number(request, "to", max_ms, max_ms);
  const auto limit = std::max(1U, whole_number(request, "limit", default_frames, most_frames));
  std::uint64_t after = 0;
  if (const auto text = request.query_value("after")) {
    for (const char c : *text) {
      if (c < '0' || c > '9' || text->size() > 16)
        refuse("invalid-argument", "must be the sequence number of a frame", "?after");
      after = after * 10 + static_cast<std::uint64_t>(c - '0');
    }
  }
  answer::RecordedFrames part{.frames = {}, .next = std::nullopt};
  recordings::RecordingCursor cursor(reader, from);
  std::uint64_t last = 0;
  std::uint32_t last_time = 0;
  for (; cursor.frame() != nullptr && cursor.time() <= to; cursor.advance()) {
    if (cursor.frame()->sequence <= after) continue;
    if (part.frames.size() == limit) {
      part.next = "/v1/recordings/" + recording.record.id + "/frames?from=" + std::to_string(last_time) +
                  "&to=" + std::to_string(to) + "&after=" + std::to_string(last) + "&limit=" + std::to_string(limit);
      break;
    }
    part.frames.push_back(represent_frame(*reader, *cursor.frame()));
    last = cursor.frame()->sequence;
    last_time = cursor.time();
  }
  if (cursor.error()) refuse_damaged(*cursor.error());
  return json_response(200, part);
}

}  // namespace semblante::api

#include <string>
#include <utility>
#include <vector>

#include "core/import/model_formats.h"
#include "protocol/cpp/fap_file_frames.h"
#include "protocol/cpp/performance_frames.h"
#include "server/api/common.h"
#include "server/api/generated/handlers.h"
#include "server/api/levels.h"
#include "server/api/model_clip.h"
#include "server/api/motion_body.h"
#include "server/api/recordings_common.h"
#include "server/http/media_type.h"

namespace semblante::api {
namespace {

struct Motion {
  std::string name;
  std::vector<TimedValues> frames;
};

Motion motion_of_fap_file(const http::Request& request) {
  if (request.query_value("rate")) refuse("invalid-argument", "a .fap file has its own rate", "?rate");
  const auto file = fap_file_of_body(request).file;
  auto frames = frames_of(file);
  if (!frames) refuse_fap_file(frames.error());
  if (frames->size() > max_clip_memory_frames)
    refuse("content-too-large", "a clip has at most " + std::to_string(max_clip_memory_frames) + " frames");
  return {file.name, std::move(*frames)};
}

Motion motion_of_performance(const http::Request& request) {
  const auto rate = whole_number(request, "rate", static_cast<std::uint32_t>(usual_frame_rate), 1000);
  if (rate == 0) refuse("invalid-argument", "must be a whole number from 1 to 1000", "?rate");
  const auto performance = performance_of_body(request);
  auto frames = frames_of(performance, rate, max_clip_memory_frames);
  if (!frames) refuse_performance(frames.error());
  return {performance.name(), std::move(*frames)};
}

}  // namespace

http::Response create_clip(Context& context, http::Request& request) {
  const auto model = model_of(context, request);
  const std::size_t level = model.package ? level_of(request, *model.package) : 0;
  // The slot is taken before the body is read: a document of 16 MiB keeps a thread busy, too.
  const auto slot = export_slot(context);
  const bool is_fap = http::essence(request.header("Content-Type").value_or("")) == "text/plain";
  const auto motion = is_fap ? motion_of_fap_file(request) : motion_of_performance(request);
  ClipOptions options;
  if (!motion.name.empty()) options.name = motion.name;
  http::Response response;
  response.headers["Content-Type"] = std::string(glb_media_type);
  response.headers["Content-Disposition"] = "attachment; filename=\"" + model.id + ".glb\"";
  response.body = clip_of_model(context, model, level, motion.frames, options);
  return response;
}

}  // namespace semblante::api

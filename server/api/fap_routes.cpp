#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "protocol/cpp/fap_file_frames.h"
#include "server/api/common.h"
#include "server/api/generated/handlers.h"
#include "server/api/motion_body.h"
#include "server/api/play_options.h"
#include "server/streams/fap_source.h"

namespace semblante::api {
namespace {

/// A query parameter with two possible values: false for the first, which is the default.
bool second_word(const http::Request& request, const std::string& name, const std::string& first,
                 const std::string& second) {
  const auto word = request.query_value(name);
  if (!word || *word == first) return false;
  if (*word == second) return true;
  refuse("invalid-argument", "must be " + first + " or " + second, "?" + name);
}

}  // namespace

http::Response play_fap_file(Context& context, http::Request& request) {
  const auto& stream = request.params.at("stream");
  const auto info = context.hub.info(stream);
  if (!info) refuse("not-found", "there is no stream " + stream);
  auto options = play_options(request);
  FapFileMeaning meaning;
  if (second_word(request, "absent", "zero", "keep")) meaning.absent = AbsentFap::keep;
  if (second_word(request, "gaps", "hold", "interpolate")) meaning.gap = FrameGap::interpolate;

  const auto reading = fap_file_of_body(request);
  const auto frames = frames_of(reading.file, meaning);
  if (!frames) refuse_fap_file(frames.error());
  // The default is the file's own rate, with which its frames are sent unchanged.
  if (!request.query_value("fps"))
    options.rate = std::clamp(reading.file.rate, streams::least_play_rate, streams::most_play_rate);
  std::vector<std::string> warnings;
  for (const auto& warning : reading.warnings) warnings.push_back(to_sentence(warning));
  auto source = streams::make_fap_source(*frames, reading.file.rate, reading.file.name,
                                         scaled_quantizers(info->settings.quantizer_scale));
  return play_into(context, stream, std::move(source), options, warnings);
}

}  // namespace semblante::api

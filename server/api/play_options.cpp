#include "server/api/play_options.h"

#include <charconv>
#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/performance/cue.h"

namespace semblante::api {
namespace {

bool flag(const http::Request& request, const std::string& name) {
  const auto text = request.query_value(name);
  if (!text || *text == "false") return false;
  if (*text == "true") return true;
  refuse("invalid-argument", "must be true or false", "?" + name);
}

double number(const http::Request& request, const std::string& name, double otherwise, double least, double most) {
  const auto text = request.query_value(name);
  if (!text) return otherwise;
  double value = 0.0;
  const auto read = std::from_chars(text->data(), text->data() + text->size(), value);
  const bool whole = read.ec == std::errc() && read.ptr == text->data() + text->size() && std::isfinite(value);
  if (!whole || value < least || value > most)
    refuse("invalid-argument",
           "must be a number from " + std::to_string(std::lround(least)) + " to " + std::to_string(std::lround(most)),
           "?" + name);
  return value;
}

}  // namespace

streams::PlayOptions play_options(const http::Request& request) {
  streams::PlayOptions options;
  options.rate = number(request, "fps", options.rate, streams::least_play_rate, streams::most_play_rate);
  options.from = number(request, "from", 0.0, 0.0, max_performance_ms);
  options.loop = flag(request, "loop");
  options.take_over = flag(request, "take_over");
  return options;
}

http::Response play_into(Context& context, const std::string& stream,
                         std::shared_ptr<const streams::FrameSource> source, const streams::PlayOptions& options,
                         const std::optional<std::vector<std::string>>& warnings) {
  if (source->duration() > 0.0 && options.from >= source->duration())
    refuse("invalid-argument", "begins after the end", "?from");
  const auto playing = context.hub.play(stream, std::move(source), options);
  if (!playing) {
    const auto& code = playing.error().code;
    const auto& message = playing.error().message;
    // What plays elsewhere has the memory, and nothing that is stored.
    if (code == ErrorCode::too_large) refuse("limit-exceeded", message, {}, std::nullopt);
    refuse(code == ErrorCode::missing ? "not-found" : "conflict", message);
  }
  const auto body = represent(*playing);
  auto response = warnings ? json_response(202, answer::PlayingFapFile{.playing = body, .warnings = *warnings})
                           : json_response(202, body);
  response.headers["Location"] = "/v1/streams/" + stream + "/performances/" + playing->id;
  return response;
}

}  // namespace semblante::api

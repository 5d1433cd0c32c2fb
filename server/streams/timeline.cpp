#include "server/streams/timeline.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

namespace semblante::streams {
namespace {

/// An error for the first frame that is too long after the beginning of its message.
Status check_length(const std::vector<TimedFrame>& frames) {
  for (std::size_t i = 0; i < frames.size(); ++i)
    if (frames[i].time > most_ahead)
      return Error{ErrorCode::out_of_range, "/frames/" + std::to_string(i) + "/time",
                   "frames of one message lie within " + std::to_string(most_ahead) + " ms"};
  return Unit{};
}

}  // namespace

std::uint64_t media_time_at(std::chrono::steady_clock::time_point began, std::chrono::steady_clock::time_point when) {
  const auto since = std::chrono::duration_cast<std::chrono::milliseconds>(when - began).count();
  return static_cast<std::uint64_t>(std::max<std::int64_t>(since, 0));
}

double server_time_now() {
  return std::max(
      0.0, std::chrono::duration<double, std::milli>(std::chrono::system_clock::now().time_since_epoch()).count());
}

Result<std::uint64_t> Timeline::place_now(std::uint64_t now, const std::vector<TimedFrame>& frames) {
  assert(!frames.empty());
  if (auto length = check_length(frames); !length) return length.error();
  const auto begin = std::max(now, newest_);
  if (begin + frames.back().time > now + most_ahead)
    return Error{ErrorCode::too_large, "/frames",
                 "with the frames that came before they would end more than " + std::to_string(most_ahead) +
                     " ms ahead of the stream's clock"};
  newest_ = begin + frames.back().time;
  return begin;
}

Result<std::uint64_t> Timeline::place_published(std::uint64_t now, std::uint64_t media_time,
                                                std::vector<TimedFrame>& frames) {
  assert(!frames.empty());
  if (auto length = check_length(frames); !length) return length.error();
  const auto begin = on_stream_clock(now, media_time, frames.back().time);
  const auto newest = static_cast<std::int64_t>(newest_);
  const auto placed = std::max(begin, newest);
  for (auto& frame : frames) {
    const auto at = std::max(begin + static_cast<std::int64_t>(frame.time), newest);
    frame.time = static_cast<decltype(frame.time)>(at - placed);
  }
  newest_ = static_cast<std::uint64_t>(placed) + frames.back().time;
  return static_cast<std::uint64_t>(placed);
}

std::int64_t Timeline::on_stream_clock(std::uint64_t now, std::uint64_t media_time, std::uint64_t lasts) {
  const auto here = static_cast<std::int64_t>(now);
  const auto theirs = static_cast<std::int64_t>(std::min<std::uint64_t>(media_time, INT64_MAX / 4));
  const auto begin = theirs + offset_;
  if (offset_known_ && begin + static_cast<std::int64_t>(lasts) <= here + static_cast<std::int64_t>(most_ahead) &&
      begin >= here - static_cast<std::int64_t>(most_behind))
    return begin;
  offset_ = here - theirs;
  offset_known_ = true;
  return here;
}

std::optional<std::uint64_t> Timeline::place_published_sound(std::uint64_t now, std::uint64_t media_time,
                                                             double lasts) {
  const auto begin = on_stream_clock(now, media_time, static_cast<std::uint64_t>(std::ceil(lasts)));
  // Packets may last half milliseconds, and media times are whole ones.
  if (begin < 0 || static_cast<double>(begin) < std::floor(sound_ends_)) return std::nullopt;
  sound_played(static_cast<std::uint64_t>(begin), lasts);
  return static_cast<std::uint64_t>(begin);
}

std::uint64_t Timeline::place_due(std::uint64_t when) {
  newest_ = std::max(newest_, when);
  return newest_;
}

}  // namespace semblante::streams

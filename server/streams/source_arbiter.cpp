#include "server/streams/source_arbiter.h"

#include <cassert>
#include <string>
#include <utility>

namespace semblante::streams {
namespace {

using Clock = SourceArbiter::Clock;

constexpr double filling_rate = 25.0;  ///< frames per second

SourceArbiter::Placement placement(Result<std::uint64_t> media_time) {
  if (!media_time) return SourceArbiter::Refusal{std::move(media_time).error(), std::nullopt};
  return *media_time;
}

SourceArbiter::Refusal mismatch(std::string message) {
  return {Error{ErrorCode::mismatch, "", std::move(message)}, std::nullopt};
}

constexpr const char* taken_over = "another source has taken over this stream";

SourceArbiter::Refusal too_many(FloodGuard& guard, FloodGuard::Verdict verdict) {
  if (verdict == FloodGuard::Verdict::drop) return {Error{ErrorCode::too_large, "/frames", ""}, verdict};
  return {Error{ErrorCode::too_large, "/frames", guard.words()}, verdict};
}

}  // namespace

SourceArbiter::SourceArbiter(bool has_filling, FloodLimits limits, std::chrono::milliseconds filling_patience,
                             Clock::time_point began)
    : has_filling_(has_filling),
      filling_patience_(filling_patience),
      limits_(limits),
      began_(began),
      requests_(limits, began) {}

Result<SourceArbiter::Claim> SourceArbiter::claim(Source source, double rate, bool take_over, Clock::time_point now) {
  assert(source != Source::request && source != Source::demo);
  if (holder_ && !take_over)
    return Error{ErrorCode::mismatch, "",
                 holder_->source == Source::connection
                     ? "a connection publishes to this stream; only one source at a time"
                     : "another source plays into this stream; only one source at a time"};
  const bool replaces_publisher = is_held_by(Source::connection);
  holder_ = Holder{++last_ticket_, source, rate, FloodGuard(limits_, now), SoundGuard(now)};
  if (source == Source::connection) timeline_.forget_publisher();
  return Claim{last_ticket_, replaces_publisher};
}

bool SourceArbiter::release(Ticket ticket, Clock::time_point now) {
  if (!holder_ || holder_->ticket != ticket) return false;
  // The silence of a publisher begins with its last frame; a player may be between two frames.
  if (holder_->source != Source::connection) heard(false, now);
  holder_.reset();
  return true;
}

void SourceArbiter::heard(bool request, Clock::time_point now) {
  last_heard_ = now;
  last_was_request_ = request;
}

SourceArbiter::Placement SourceArbiter::place_published(Ticket ticket, std::uint64_t media_time,
                                                        std::vector<TimedFrame>& frames, Clock::time_point now) {
  if (!holder_ || holder_->ticket != ticket) return mismatch(taken_over);
  if (const auto verdict = holder_->guard.offer(frames.size(), now); verdict != FloodGuard::Verdict::take) {
    auto refusal = too_many(holder_->guard, verdict);
    if (verdict == FloodGuard::Verdict::close) {
      // The publisher counts as active until now, even if its frames were dropped.
      heard(false, now);
      holder_.reset();
    }
    return refusal;
  }
  auto placed = placement(media_time == 0 ? timeline_.place_now(media_time_at(now), frames)
                                          : timeline_.place_published(media_time_at(now), media_time, frames));
  if (std::holds_alternative<std::uint64_t>(placed)) heard(false, now);
  return placed;
}

Result<std::optional<std::uint64_t>> SourceArbiter::place_sound(Ticket ticket, const SoundPacket& sound,
                                                                Clock::time_point now) {
  if (!holds(ticket)) return Error{ErrorCode::mismatch, "", taken_over};
  const auto lasts = holder_->sound.check(sound, now);
  if (!lasts) return lasts.error();
  heard(false, now);
  return timeline_.place_published_sound(media_time_at(now), sound.media_time, *lasts);
}

SourceArbiter::Placement SourceArbiter::place_request(std::vector<TimedFrame>& frames, Clock::time_point now) {
  if (is_held_by(Source::connection))
    return mismatch("a connection publishes to this stream; only one source at a time");
  if (holder_)
    return mismatch("a " + std::string(source_names[static_cast<std::size_t>(holder_->source)]) +
                    " plays into this stream; only one source at a time");
  if (const auto verdict = requests_.offer(frames.size(), now); verdict != FloodGuard::Verdict::take)
    return Refusal{Error{ErrorCode::too_large, "/frames", requests_.words()}, verdict};
  auto placed = placement(timeline_.place_now(media_time_at(now), frames));
  if (std::holds_alternative<std::uint64_t>(placed)) heard(true, now);
  return placed;
}

std::optional<std::uint64_t> SourceArbiter::place_played(Ticket ticket, Clock::time_point when, Clock::time_point now) {
  if (!holder_ || holder_->ticket != ticket) return std::nullopt;
  heard(false, now);
  return timeline_.place_due(media_time_at(when));
}

std::optional<std::uint64_t> SourceArbiter::place_filling(Clock::time_point when, Clock::time_point now) {
  if (holder_ || (last_heard_ && now - *last_heard_ < filling_patience_)) return std::nullopt;
  return timeline_.place_due(media_time_at(when));
}

std::optional<Source> SourceArbiter::active(Clock::time_point now) const {
  if (holder_) return holder_->source;
  if (last_was_request_ && now - *last_heard_ < filling_patience_) return Source::request;
  if (has_filling_) return Source::demo;
  return std::nullopt;
}

double SourceArbiter::rate() const {
  if (holder_ && holder_->source != Source::connection) return holder_->rate;
  return has_filling_ ? filling_rate : 0.0;
}

Clock::time_point SourceArbiter::newest_frame_time() const {
  return began_ + std::chrono::milliseconds(timeline_.newest());
}

}  // namespace semblante::streams

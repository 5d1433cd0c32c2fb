#include <algorithm>
#include <cmath>
#include <memory>

#include "clients/runtime/border.h"
#include "clients/runtime/handles.h"
#include "clients/runtime/head.h"
#include "clients/runtime/times.h"

namespace semblante::runtime {
namespace {

/// Fewer frames would not be enough for two messages and a curve.
constexpr std::uint32_t least_held = 16;

/// Sets the pose of a head to a moment; false if it has that pose already.
bool show(const Moment& moment, semblante_head& head) {
  semblante_rig rig = head.rig;
  if (moment.viseme_share) rig.viseme_share = static_cast<float>(*moment.viseme_share);
  EvaluatedPoses& poses = *head.evaluated;
  const bool has_before = moment.is_curve && moment.spans[0] > 0;
  const bool has_after = moment.is_curve && moment.spans[2] > 0;
  const semblante_pose& from = poses.of(rig, moment.frames[1]);
  const semblante_pose& to = poses.of(rig, moment.frames[2]);
  const semblante_pose& before = has_before ? poses.of(rig, moment.frames[0]) : from;
  const semblante_pose& after = has_after ? poses.of(rig, moment.frames[3]) : to;
  ShownPose shown;
  shown.poses = {has_before ? poses.number_of(before) : 0, poses.number_of(from), poses.number_of(to),
                 has_after ? poses.number_of(after) : 0};
  shown.t = moment.t;
  if (moment.is_curve) shown.spans = moment.spans;
  if (shown == head.shown) return false;
  head.shown = shown;
  if (moment.is_curve) {
    semblante_ease(&before, &from, &to, &after, moment.spans.data(), moment.t, &head.pose);
  } else {
    semblante_interpolate(&from, &to, moment.t, &head.pose);
  }
  return true;
}

bool are_finite(const semblante_timed_frame* frames, uint32_t count) {
  return std::all_of(frames, frames + count, [before = -9e15](const semblante_timed_frame& frame) mutable {
    const bool rises = is_time(frame.time) && frame.time >= before;
    before = frame.time;
    return rises && is_finite(frame.frame);
  });
}

}  // namespace
}  // namespace semblante::runtime

using namespace semblante::runtime;

extern "C" {

semblante_result semblante_player_create(const semblante_player_options* options, semblante_player** player,
                                         semblante_error* error) {
  if (player == nullptr) return fail(error, SEMBLANTE_INVALID_ARGUMENT, "player", "the pointer for it is null");
  *player = nullptr;
  semblante_player_options chosen;
  if (!read_struct(options, chosen)) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "options", "its size is not set");
  }
  if (!is_time(chosen.delay) || chosen.delay < 0) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "options.delay", "must be a number of milliseconds, 0 or more");
  }
  PlayerOptions made;
  made.playout.eased = chosen.eased != 0;
  if (chosen.delay > 0) made.playout.delay = chosen.delay;
  if (chosen.max_frames > 0) made.max_frames = std::max(chosen.max_frames, least_held);
  return guarded(error, [&] {
    *player = std::make_unique<semblante_player>(made).release();
    return SEMBLANTE_OK;
  });
}

void semblante_player_destroy(semblante_player* player) { delete player; }

semblante_result semblante_player_follow(semblante_player* player, semblante_stream* stream) {
  if (player == nullptr) return SEMBLANTE_INVALID_ARGUMENT;
  return guarded(nullptr, [&] {
    player->it.follow(stream == nullptr ? nullptr : &stream->it);
    return SEMBLANTE_OK;
  });
}

semblante_result semblante_player_push(semblante_player* player, const semblante_timed_frame* frames, uint32_t count,
                                       double now) {
  if (player == nullptr || (frames == nullptr && count != 0) || !is_time(now) || player->it.followed() != nullptr ||
      !are_finite(frames, count)) {
    return SEMBLANTE_INVALID_ARGUMENT;
  }
  return guarded(nullptr, [&] {
    player->it.push(std::span(frames, count), now);
    return SEMBLANTE_OK;
  });
}

uint32_t semblante_player_advance(semblante_player* player, double now, double elapsed) {
  uint32_t has_any = 0;
  if (player != nullptr && is_time(now)) guarded([&] { has_any = player->it.advance(now, elapsed) ? 1 : 0; });
  return has_any;
}

uint32_t semblante_player_move_to(semblante_player* player, double media_time) {
  return player != nullptr && is_time(media_time) && player->it.move_to(media_time) ? 1 : 0;
}

uint32_t semblante_player_show(const semblante_player* player, semblante_head* head) {
  if (player == nullptr || head == nullptr || !player->it.has_moment()) return 0;
  return show(player->it.moment(), *head) ? 1 : 0;
}

semblante_result semblante_player_between(const semblante_player* player, semblante_timed_frame* from,
                                          semblante_timed_frame* to, float* t) {
  if (player == nullptr || from == nullptr || to == nullptr || t == nullptr) return SEMBLANTE_INVALID_ARGUMENT;
  if (!player->it.has_moment()) return SEMBLANTE_UNAVAILABLE;
  const Moment& moment = player->it.moment();
  *from = {moment.from_time, moment.frames[1]};
  *to = {moment.to_time, moment.frames[2]};
  *t = moment.t;
  return SEMBLANTE_OK;
}

semblante_result semblante_player_moment(const semblante_player* player, semblante_moment* moment) {
  if (player == nullptr) return SEMBLANTE_INVALID_ARGUMENT;
  if (!player->it.has_moment()) return SEMBLANTE_UNAVAILABLE;
  const Moment& from = player->it.moment();
  semblante_moment made{};
  made.is_curve = from.is_curve ? 1 : 0;
  made.from_time = from.from_time;
  made.to_time = from.to_time;
  made.viseme_share = from.viseme_share.value_or(unknown_time);
  made.t = from.t;
  std::copy(from.spans.begin(), from.spans.end(), made.spans);
  std::copy(from.frames.begin(), from.frames.end(), made.frames);
  return write_struct(made, moment) ? SEMBLANTE_OK : SEMBLANTE_INVALID_ARGUMENT;
}

double semblante_player_time(const semblante_player* player) {
  return player == nullptr ? unknown_time : player->it.playout().playhead();
}

semblante_result semblante_player_stats(const semblante_player* player, semblante_player_statistics* statistics) {
  if (player == nullptr) return SEMBLANTE_INVALID_ARGUMENT;
  const PlayoutStats stats = player->it.playout().stats();
  semblante_player_statistics made{};
  made.held = static_cast<uint32_t>(player->it.held());
  made.delay = player->it.playout().delay();
  made.wanted_delay = stats.wanted_delay;
  made.jitter = stats.jitter;
  made.error = stats.error;
  made.starved_time = stats.starved_time;
  made.starved = stats.starved;
  made.snaps = stats.snaps;
  return write_struct(made, statistics) ? SEMBLANTE_OK : SEMBLANTE_INVALID_ARGUMENT;
}

void semblante_player_clear(semblante_player* player) {
  if (player != nullptr) player->it.clear();
}

}  // extern "C"

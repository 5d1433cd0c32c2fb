#include "server/streams/stream_hub.h"

#include <algorithm>
#include <utility>

#include "server/http/media_type.h"
#include "server/log/guard.h"
#include "server/streams/performance_source.h"
#include "server/streams/stream_connection.h"

namespace semblante::streams {
namespace {

constexpr std::chrono::milliseconds look_interval{200};
/// Of a stream's own filling: see Player's constructor.
constexpr std::uint64_t no_ticket = 0;

}  // namespace

InProcessHub::InProcessHub(StreamLimits limits, std::unique_ptr<http::GroupSender> group_sender)
    : limits_(limits),
      sender_(std::make_shared<BatchSender>(std::move(group_sender))),
      thread_([this] { log::keep_running("the hub", [this] { run(); }); }) {}

InProcessHub::~InProcessHub() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
  sender_->stop();
}

std::shared_ptr<Stream> InProcessHub::find(std::string_view id) const {
  const std::lock_guard lock(mutex_);
  const auto found = streams_.find(id);
  return found == streams_.end() ? nullptr : found->second;
}

void InProcessHub::set_listener(std::shared_ptr<BatchListener> listener) {
  const std::lock_guard lock(mutex_);
  listener_ = std::move(listener);
  for (const auto& [id, stream] : streams_) stream->set_listener(listener_);
}

bool InProcessHub::open(const StreamInfo& info) {
  const std::lock_guard lock(mutex_);
  if (stopping_ || shut_down_ || streams_.contains(info.id)) return false;
  // Epochs never repeat, even across restarts, so that a resume point of an earlier instance is never accepted.
  last_epoch_ = std::max(last_epoch_ + 1, static_cast<std::uint64_t>(server_time_now()));
  StreamInfo full = info;
  full.epoch = last_epoch_;
  const auto stream =
      streams_.emplace(info.id, std::make_shared<Stream>(std::move(full), limits_, sender_)).first->second;
  stream->set_listener(listener_);
  order_.push_back(info.id);
  if (info.source == "demo") {
    PlayOptions options;
    options.loop = true;
    fillings_.emplace(info.id, std::make_shared<Playing>(
                                   Player("", stream, no_ticket, demo_source(), options, Player::Clock::now())));
    more_to_play_ = true;
    changed_.notify_all();
  }
  return true;
}

bool InProcessHub::close(std::string_view id, EndReason reason) {
  const auto stream = find(id);
  if (!stream) return false;
  // Ended before it is removed, so that its last events are in the sum of counts() and that sum never decreases.
  stream->end(reason);
  const std::lock_guard lock(mutex_);
  const auto found = streams_.find(id);
  if (found == streams_.end() || found->second != stream) return false;  // another thread has closed it
  streams_.erase(found);
  std::erase(order_, id);
  for (auto* players : {&playing_, &fillings_}) {
    if (const auto player = players->find(id); player != players->end()) players->erase(player);
  }
  if (const auto failed = failed_.find(id); failed != failed_.end()) failed_.erase(failed);
  gone_ += stream->counts();
  return true;
}

void InProcessHub::shut_down() {
  std::vector<std::string> ids;
  {
    const std::lock_guard lock(mutex_);
    shut_down_ = true;
    ids = order_;
  }
  for (const auto& id : ids) close(id, EndReason::shutdown);
}

std::shared_ptr<InProcessHub::Playing> InProcessHub::find_playing(std::string_view id) const {
  const std::lock_guard lock(mutex_);
  const auto found = playing_.find(id);
  return found == playing_.end() ? nullptr : found->second;
}

StreamInfo InProcessHub::full_info(std::string_view id, const Stream& stream) const {
  StreamInfo info = stream.info();
  if (const auto playing = find_playing(id)) {
    const std::lock_guard lock(playing->mutex);
    const bool plays = info.active_source && *info.active_source != Source::connection;
    if (plays && !playing->player.finished()) info.playing = playing->player.status(Player::Clock::now());
  }
  const std::lock_guard lock(mutex_);
  if (const auto failed = failed_.find(id); failed != failed_.end()) info.failed = failed->second;
  return info;
}

std::vector<StreamInfo> InProcessHub::list() const {
  std::vector<std::shared_ptr<Stream>> all;
  std::vector<std::string> ids;
  {
    const std::lock_guard lock(mutex_);
    ids = order_;
    for (const auto& id : ids) all.push_back(streams_.find(id)->second);
  }
  std::vector<StreamInfo> list;
  for (std::size_t i = 0; i < all.size(); ++i) list.push_back(full_info(ids[i], *all[i]));
  return list;
}

std::optional<StreamInfo> InProcessHub::info(std::string_view id) const {
  const auto stream = find(id);
  if (!stream) return std::nullopt;
  return full_info(id, *stream);
}

std::optional<Header> InProcessHub::header(std::string_view id) const {
  const auto stream = find(id);
  if (!stream) return std::nullopt;
  return stream->header();
}

StreamCounts InProcessHub::counts() const {
  const std::lock_guard lock(mutex_);
  StreamCounts sum = gone_;
  for (const auto& [id, stream] : streams_) sum += stream->counts();
  return sum;
}

Result<PublishReceipt> InProcessHub::publish(std::string_view id, const std::vector<TimedFrame>& frames) {
  const auto stream = find(id);
  if (!stream) return Error{ErrorCode::missing, "", "there is no such stream"};
  return stream->publish_request(frames);
}

std::variant<std::shared_ptr<http::WebSocketPeer>, Refusal> InProcessHub::connect(std::string_view id,
                                                                                  std::string_view offered,
                                                                                  ConnectionRights rights) {
  const auto stream = find(id);
  if (!stream) return Refusal::no_such_stream;
  // The first offered subprotocol that the server supports; JSON, which can be typed by hand, when none is offered.
  bool binary = false;
  bool known = false;
  for (const auto& name : http::split_list(offered)) {
    if (name != binary_subprotocol && name != json_subprotocol) continue;
    binary = name == binary_subprotocol;
    known = true;
    break;
  }
  auto connection = std::make_shared<StreamConnection>(stream, binary, known, std::move(rights));
  if (!stream->admit(connection)) return Refusal::too_many;
  return std::shared_ptr<http::WebSocketPeer>(std::move(connection));
}

Result<PlayStatus> InProcessHub::play(std::string_view id, std::shared_ptr<const FrameSource> source,
                                      const PlayOptions& options) {
  const std::lock_guard lock(mutex_);
  const auto found = streams_.find(id);
  if (stopping_ || found == streams_.end()) return Error{ErrorCode::missing, "", "there is no such stream"};
  std::size_t bytes = source->bytes();
  for (const auto& [stream, playing] : playing_) bytes += stream == id ? 0 : playing->player.source_bytes();
  if (bytes > limits_.playing_bytes)
    return Error{ErrorCode::too_large, "", "the memory limit of all playing sources is reached"};
  auto ticket = found->second->begin_playing(options.rate, options.take_over, played_source(source->kind()));
  if (!ticket) return std::move(ticket).error();
  const auto now = Player::Clock::now();
  // Frames that another source sent in advance are shown first; they end at most most_ahead from now.
  const auto begin = std::max(now, found->second->newest_frame_time());
  // Like epochs, ids never repeat across restarts, so that an old URL never stops another play.
  last_play_ = std::max(last_play_ + 1, static_cast<std::uint64_t>(server_time_now()));
  auto playing = std::make_shared<Playing>(
      Player(std::to_string(last_play_), found->second, *ticket, std::move(source), options, begin));
  PlayStatus status = playing->player.status(now);
  playing_[std::string(id)] = std::move(playing);
  if (const auto failed = failed_.find(id); failed != failed_.end()) failed_.erase(failed);
  more_to_play_ = true;
  changed_.notify_all();
  return status;
}

bool InProcessHub::stop(std::string_view id, std::string_view play_id) {
  const auto playing = find_playing(id);
  if (!playing) return false;
  const std::lock_guard lock(playing->mutex);
  Player& player = playing->player;
  if (player.finished() || player.id() != play_id) return false;
  player.stop();
  return true;
}

std::vector<std::shared_ptr<InProcessHub::Playing>> InProcessHub::all_playing() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::shared_ptr<Playing>> all;
  for (const auto& [id, playing] : playing_) all.push_back(playing);
  for (const auto& [id, filling] : fillings_) all.push_back(filling);
  return all;
}

void InProcessHub::forget(const std::vector<std::shared_ptr<Playing>>& finished) {
  for (const auto& done : finished) {
    PlayStatus status;
    {
      const std::lock_guard lock(done->mutex);
      status = done->player.status(Player::Clock::now());
    }
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(playing_.begin(), playing_.end(), [&](const auto& p) { return p.second == done; });
    if (found == playing_.end()) continue;
    if (!status.making.failure.empty()) failed_[found->first] = std::move(status);
    playing_.erase(found);
  }
}

void InProcessHub::run() {
  auto next_look = Player::Clock::now();
  auto next = next_look;
  while (true) {
    std::vector<std::shared_ptr<Stream>> all;
    {
      std::unique_lock lock(mutex_);
      changed_.wait_until(lock, next, [this] { return stopping_ || more_to_play_; });
      if (stopping_) return;
      more_to_play_ = false;
      if (Player::Clock::now() >= next_look) {
        for (const auto& [id, stream] : streams_) all.push_back(stream);
      }
    }
    for (const auto& stream : all)
      log::guarded("looking after a stream's connections", [&] { stream->look_after_connections(); });
    if (!all.empty() || Player::Clock::now() >= next_look) next_look += look_interval;
    next = next_look;
    std::vector<std::shared_ptr<Playing>> finished;
    for (const auto& playing : all_playing()) {
      const std::lock_guard lock(playing->mutex);
      // A source that fails is stopped: it would fail again at its next frame.
      if (!log::guarded("playing into a stream", [&] { playing->player.play(Player::Clock::now()); }))
        log::guarded("stopping what plays", [&] { playing->player.stop(); });
      next = std::min(next, playing->player.next());
      if (playing->player.finished()) finished.push_back(playing);
    }
    if (!finished.empty()) forget(finished);
  }
}

}  // namespace semblante::streams

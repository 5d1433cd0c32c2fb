#include "server/streams/stream_hub.h"

#include <algorithm>
#include <utility>

#include "server/http/media_type.h"
#include "server/streams/demo_performance.h"
#include "server/streams/stream_connection.h"

namespace semblante::streams {
namespace {

constexpr std::chrono::milliseconds demo_interval{40};
constexpr int ticks_per_look = 5;

void add(StreamCounts& sum, const StreamCounts& counts) {
  sum.frames += counts.frames;
  sum.messages_sent += counts.messages_sent;
  sum.messages_replaced += counts.messages_replaced;
  sum.closed_slow += counts.closed_slow;
  sum.refused += counts.refused;
}

}  // namespace

InProcessHub::InProcessHub(StreamLimits limits) : limits_(limits), thread_([this] { tick(); }) {}

InProcessHub::~InProcessHub() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  stopping_changed_.notify_all();
  thread_.join();
}

std::shared_ptr<Stream> InProcessHub::find(std::string_view id) const {
  const std::lock_guard lock(mutex_);
  const auto found = streams_.find(id);
  return found == streams_.end() ? nullptr : found->second;
}

bool InProcessHub::open(const StreamInfo& info) {
  const std::lock_guard lock(mutex_);
  if (stopping_ || streams_.contains(info.id)) return false;
  // Epochs never repeat, over restarts too: sequence numbers of another life must not be taken for this one's.
  last_epoch_ = std::max(last_epoch_ + 1, static_cast<std::uint64_t>(Stream::server_time_now()));
  StreamInfo full = info;
  full.epoch = last_epoch_;
  streams_.emplace(info.id, std::make_shared<Stream>(std::move(full), limits_));
  order_.push_back(info.id);
  return true;
}

bool InProcessHub::close(std::string_view id, EndReason reason) {
  std::shared_ptr<Stream> stream;
  {
    const std::lock_guard lock(mutex_);
    const auto found = streams_.find(id);
    if (found == streams_.end()) return false;
    stream = found->second;
    streams_.erase(found);
    std::erase(order_, id);
    add(gone_, stream->counts());
  }
  stream->end(reason);
  return true;
}

void InProcessHub::close_all(EndReason reason) {
  std::vector<std::string> ids;
  {
    const std::lock_guard lock(mutex_);
    ids = order_;
  }
  for (const auto& id : ids) close(id, reason);
}

std::vector<StreamInfo> InProcessHub::list() const {
  const std::lock_guard lock(mutex_);
  std::vector<StreamInfo> list;
  for (const auto& id : order_) list.push_back(streams_.find(id)->second->info());
  return list;
}

std::optional<StreamInfo> InProcessHub::info(std::string_view id) const {
  const auto stream = find(id);
  if (!stream) return std::nullopt;
  return stream->info();
}

StreamCounts InProcessHub::counts() const {
  const std::lock_guard lock(mutex_);
  StreamCounts sum = gone_;
  for (const auto& [id, stream] : streams_) add(sum, stream->counts());
  return sum;
}

Result<PublishReceipt> InProcessHub::publish(std::string_view id, const std::vector<TimedFrame>& frames) {
  const auto stream = find(id);
  if (!stream) return Error{ErrorCode::missing, "", "there is no such stream"};
  return stream->publish(Source::request, 0, frames);
}

std::variant<std::shared_ptr<http::WebSocketPeer>, Refusal> InProcessHub::connect(std::string_view id,
                                                                                  std::string_view offered) {
  const auto stream = find(id);
  if (!stream) return Refusal::no_such_stream;
  // The first of the client's offers that we speak; JSON, to read and write by hand, when it offers none.
  bool binary = false;
  bool known = false;
  for (const auto& name : http::split_list(offered)) {
    if (name != binary_subprotocol && name != json_subprotocol) continue;
    binary = name == binary_subprotocol;
    known = true;
    break;
  }
  auto connection = std::make_shared<StreamConnection>(stream, binary, known);
  if (!stream->admit(connection)) return Refusal::too_many;
  return std::shared_ptr<http::WebSocketPeer>(std::move(connection));
}

void InProcessHub::tick() {
  const DemoPerformance performance;
  const auto begin = std::chrono::steady_clock::now();
  for (int round = 0;; ++round) {
    std::vector<std::shared_ptr<Stream>> all;
    std::vector<std::shared_ptr<Stream>> demos;
    {
      std::unique_lock lock(mutex_);
      if (stopping_changed_.wait_until(lock, begin + round * demo_interval, [this] { return stopping_; })) return;
      for (const auto& [id, stream] : streams_) {
        if (stream->info().source == "demo") demos.push_back(stream);
        if (round % ticks_per_look == 0) all.push_back(stream);
      }
    }
    const auto frame = performance.frame_at(round * demo_interval);
    for (const auto& stream : demos) (void)stream->publish(Source::demo, 0, {TimedFrame{0, frame}});
    for (const auto& stream : all) stream->look_after_connections();
  }
}

}  // namespace semblante::streams

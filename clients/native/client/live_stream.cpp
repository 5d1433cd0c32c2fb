#include "clients/native/client/live_stream.h"

#include <algorithm>
#include <thread>
#include <utility>
#include <variant>

namespace semblante::client {
namespace {

using Clock = LiveStream::Clock;

Clock::duration milliseconds(double ms) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double, std::milli>(ms));
}

double to_ms(Clock::time_point when) {
  return std::chrono::duration<double, std::milli>(when.time_since_epoch()).count();
}

}  // namespace

LiveStream::LiveStream(ServerAddress server, std::string stream, LiveStreamOptions options)
    : server_(std::move(server)), stream_(std::move(stream)), options_(options), random_(options.seed) {
  resume_ = options_.stream.resume;
}

double LiveStream::now() { return to_ms(Clock::now()); }

Status LiveStream::connect() {
  StreamOptions options = options_.stream;
  options.resume = resume_;
  greeted_ = false;
  ++connections_;
  auto client = StreamClient::connect(server_, stream_, options);
  if (!client) {
    lose();
    const ErrorCode code = client.error().code;
    const bool is_final =
        code == ErrorCode::missing || code == ErrorCode::mismatch || code == ErrorCode::invalid_argument;
    return is_final ? Status(std::move(client).error()) : Unit{};
  }
  client_.emplace(*std::move(client));
  sent_resume_ = resume_;
  return Unit{};
}

void LiveStream::lose() {
  client_.reset();
  greeted_ = false;
  const auto longest = static_cast<double>(options_.longest_pause.count());
  const double doubled = static_cast<double>(options_.first_pause.count()) *
                         static_cast<double>(std::uint64_t{1} << std::min<std::uint64_t>(tries_, 30));
  ++tries_;
  // Half of the pause is random, so that many clients do not reconnect at the same time.
  const double share = std::uniform_real_distribution<double>(0.5, 1.0)(random_);
  next_try_ = Clock::now() + milliseconds(std::min(longest, doubled) * share);
}

Result<std::optional<Message>> LiveStream::next(std::chrono::milliseconds timeout) {
  const auto deadline = Clock::now() + timeout;
  while (!over_) {
    if (!client_) {
      if (next_try_ > deadline) {
        break;
      }
      std::this_thread::sleep_until(next_try_);
      if (auto connected = connect(); !connected) {
        return std::move(connected).error();
      }
    }
    if (!client_) {
      continue;
    }
    ping();
    const auto until = greeted_ ? std::min(deadline, next_ping_) : deadline;
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
    auto message = client_->next(std::max(left, std::chrono::milliseconds(0)));
    if (!message) {
      // Closed, or not readable: a missed message affects every later difference, so the client must reconnect.
      lose();
    } else if (*message) {
      take(**message, now());
      return message;
    }
    if (Clock::now() >= deadline) {
      return std::optional<Message>();
    }
  }
  std::this_thread::sleep_until(deadline);
  return std::optional<Message>();
}

void LiveStream::take(const Message& message, double received) {
  if (const auto* header = std::get_if<Header>(&message)) {
    if (header_ && header_->epoch != header->epoch) {
      clock_.clear();
    }
    clock_.answered(to_ms(client_->hello_sent()), received, static_cast<double>(header->media_time));
    header_ = *header;
    if (!resume_ || resume_->epoch != header->epoch) {
      resume_.reset();  // there is no resume point until the keyframe
    }
    greeted_ = true;
    tries_ = 0;
    pings_ = 0;
    next_ping_ = Clock::now();
  } else if (const auto* keyframe = std::get_if<Keyframe>(&message); keyframe != nullptr && header_) {
    resume_ = ResumePoint{header_->epoch, keyframe->sequence};
  } else if (const auto* frames = std::get_if<Frames>(&message); frames != nullptr && header_) {
    resume_ = ResumePoint{header_->epoch, frames->sequence + frames->frames.size() - 1};
  } else if (const auto* pong = std::get_if<Pong>(&message)) {
    clock_.answered(pong->client_time, received, static_cast<double>(pong->media_time));
  } else if (const auto* end = std::get_if<End>(&message)) {
    over_ =
        end->reason == EndReason::finished || end->reason == EndReason::deleted || end->reason == EndReason::replaced;
  }
}

void LiveStream::ping() {
  if (!greeted_ || Clock::now() < next_ping_) {
    return;
  }
  Ping ping;
  ping.id = ++ping_id_;
  ping.client_time = now();
  ++pings_;
  next_ping_ = Clock::now() + milliseconds(ping_pause(pings_, clock_.uncertainty().value_or(0)));
  // If it cannot be sent, the next read reports the error.
  static_cast<void>(client_->send(ping));
}

}  // namespace semblante::client

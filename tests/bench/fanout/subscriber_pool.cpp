#include "tests/bench/fanout/subscriber_pool.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <sys/epoll.h>
#include <sys/socket.h>

namespace semblante::bench {
namespace {

using Clock = std::chrono::steady_clock;
/// Handshakes under way at a time: within every listener's backlog.
constexpr std::size_t connects_at_once = 128;
/// One subscriber of so many decodes everything itself.
constexpr std::size_t sample_every = 97;
constexpr std::size_t buffer_bytes = 256 * 1024;
/// A subscriber may be so far ahead of all others when it joins in the middle of a round of sending.
constexpr std::size_t most_early = 1024;

}  // namespace

SubscriberPool::SubscriberPool(const Endpoint& endpoint, std::string path, Timeline& timeline)
    : endpoint_(endpoint),
      path_(std::move(path)),
      upgrade_(upgrade_request(endpoint.authority(), path_, timeline.content().subprotocol())),
      timeline_(timeline),
      epoll_(epoll_create1(EPOLL_CLOEXEC)),
      buffer_(buffer_bytes) {}

SubscriberPool::~SubscriberPool() {
  for (Subscriber& subscriber : subscribers_) subscriber.socket.reset();
}

// ---- connecting ----------------------------------------------------------------------------------------------------

void SubscriberPool::begin(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t number = subscribers_.size();
    Subscriber subscriber;
    subscriber.socket = begin_connect(endpoint_, number - left_);
    if (number % sample_every == 0) subscriber.sample = timeline_.content().sample();
    epoll_event event{};
    event.events = EPOLLOUT;
    event.data.u64 = number;
    epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, subscriber.socket.get(), &event);
    subscribers_.push_back(std::move(subscriber));
    ++pending_;
  }
}

void SubscriberPool::open(std::size_t count) {
  const auto end = Clock::now() + std::chrono::seconds(60) + static_cast<int>(count) * std::chrono::milliseconds(10);
  const std::size_t wanted = live_ + count;
  for (std::size_t begun = 0; live_ < wanted;) {
    // The first one alone: the timeline begins where it joins, before all others.
    const std::size_t most = live_ == 0 ? 1 : connects_at_once;
    if (begun < count && pending_ < most) {
      const std::size_t more = std::min(most - pending_, count - begun);
      begin(more);
      begun += more;
    }
    run_until(std::min(end, Clock::now() + std::chrono::milliseconds(2)));
    if (counts_.refused > 0 || Clock::now() >= end)
      give_up("only " + std::to_string(live_) + " of " + std::to_string(wanted) + " subscribers of " + path_ +
              " came to read; " + (trouble_.empty() ? "the others wait" : trouble_));
  }
}

void SubscriberPool::leave(std::size_t count) {
  for (; count > 0 && left_ < subscribers_.size(); ++left_) {
    Subscriber& subscriber = subscribers_[left_];
    if (subscriber.state == State::gone) continue;
    if (subscriber.state == State::live)
      --live_;
    else
      --pending_;
    subscriber.state = State::gone;
    if (left_ % 2 == 0)
      subscriber.socket.close();
    else
      subscriber.socket.reset();
    subscriber.rest = {};
    --count;
  }
}

void SubscriberPool::connected(Subscriber& subscriber, std::size_t number) {
  int error = 0;
  socklen_t size = sizeof error;
  getsockopt(subscriber.socket.get(), SOL_SOCKET, SO_ERROR, &error, &size);
  if (error != 0) return lose(subscriber, std::string("connect: ") + std::strerror(error));
  // Edges: a level would be looked at twice for each message. OpenSSL does not tell whether it has taken all there is.
  epoll_event event{};
  event.events = EPOLLIN | EPOLLRDHUP | (endpoint_.tls ? 0U : static_cast<unsigned>(EPOLLET));
  event.data.u64 = number;
  epoll_ctl(epoll_.get(), EPOLL_CTL_MOD, subscriber.socket.get(), &event);
  subscriber.state = State::securing;
  secure(subscriber);
}

void SubscriberPool::secure(Subscriber& subscriber) {
  const auto step = subscriber.socket.handshake();
  if (step == Socket::Step::failed) return lose(subscriber, "the handshake of TLS failed");
  if (step == Socket::Step::wait) return;
  subscriber.state = State::upgrading;
  say(subscriber, upgrade_);
}

void SubscriberPool::say(Subscriber& subscriber, std::string_view bytes) {
  if (!subscriber.socket.send_all_in_time(bytes)) lose(subscriber, std::string("send: ") + std::strerror(errno));
}

std::string_view SubscriberPool::take_upgrade(Subscriber& subscriber, std::string_view bytes) {
  const auto end = bytes.find("\r\n\r\n");
  if (end == std::string_view::npos) return bytes;
  const auto head = bytes.substr(0, end);
  if (!head.starts_with("HTTP/1.1 101") || head.find(sample_accept) == std::string_view::npos) {
    lose(subscriber, "the handshake was answered " + std::string(head.substr(0, head.find("\r\n"))));
    return {};
  }
  const auto& hello = timeline_.content().hello();
  if (hello.empty()) {
    subscriber.state = State::live;
    ++live_;
    --pending_;
  } else {
    subscriber.state = State::joining;
    say(subscriber, hello);
  }
  return bytes.substr(end + 4);
}

// ---- reading -------------------------------------------------------------------------------------------------------

void SubscriberPool::run_for(std::chrono::duration<double> time) {
  run_until(Clock::now() + std::chrono::duration_cast<Clock::duration>(time));
}

void SubscriberPool::run_until_delivered() {
  const auto end = Clock::now() + std::chrono::minutes(2);
  while (counts_.delivered == 0 && live_ > 0 && Clock::now() < end) run_for(std::chrono::milliseconds(20));
}

void SubscriberPool::run_until(Clock::time_point end) {
  std::array<epoll_event, 512> events;
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()).count();
    if (left <= 0) return;
    const int count = epoll_wait(epoll_.get(), events.data(), static_cast<int>(events.size()),
                                 static_cast<int>(std::min(left, 100L)));
    for (int i = 0; i < count; ++i) {
      const epoll_event& event = events[static_cast<std::size_t>(i)];
      ready(static_cast<std::size_t>(event.data.u64), event.events);
    }
  }
}

void SubscriberPool::ready(std::size_t number, std::uint32_t events) {
  Subscriber& subscriber = subscribers_[number];
  if (subscriber.state == State::gone) return;
  if (subscriber.state == State::connecting) return connected(subscriber, number);
  if (subscriber.state == State::securing) return secure(subscriber);
  // One call takes all there is, unless it fills the buffer or the end follows.
  const bool ends = (events & (EPOLLRDHUP | EPOLLHUP | EPOLLERR)) != 0;
  ssize_t size = 0;
  while ((size = subscriber.socket.receive(buffer_.data(), buffer_.size())) > 0) {
    take(subscriber, {buffer_.data(), static_cast<std::size_t>(size)}, now_ns());
    if (subscriber.state == State::gone) return;
    if (!ends && static_cast<std::size_t>(size) < buffer_.size() && !subscriber.socket.holds_more()) return;
  }
  if (size < 0 && errno == EAGAIN) return;
  lose(subscriber, size == 0 ? "the server closed the connection" : std::string("recv: ") + std::strerror(errno));
}

void SubscriberPool::take(Subscriber& subscriber, std::string_view bytes, std::int64_t now) {
  std::string joined;
  if (!subscriber.rest.empty()) {
    joined = std::exchange(subscriber.rest, {});
    joined.append(bytes);
    bytes = joined;
  }
  if (subscriber.state == State::upgrading) bytes = take_upgrade(subscriber, bytes);
  if (subscriber.state != State::upgrading) bytes = take_frames(subscriber, bytes, now);
  if (subscriber.state != State::gone && !bytes.empty()) subscriber.rest = bytes;
}

std::string_view SubscriberPool::take_frames(Subscriber& subscriber, std::string_view bytes, std::int64_t now) {
  while (subscriber.state != State::gone) {
    FrameHead head;
    const auto state = read_head(bytes, head);
    if (state == HeadState::wrong) {
      ++counts_.gaps;
      lose(subscriber, "bytes that are no WebSocket frame of a server");
      return {};
    }
    if (state == HeadState::incomplete || bytes.size() < head.head_bytes + head.payload_bytes) return bytes;
    const auto payload = bytes.substr(head.head_bytes, head.payload_bytes);
    bytes.remove_prefix(head.head_bytes + head.payload_bytes);
    if (head.opcode == Opcode::binary || head.opcode == Opcode::text)
      message(subscriber, payload, now);
    else if (head.opcode == Opcode::ping)
      say(subscriber, client_frame(Opcode::pong, payload));
    else if (head.opcode == Opcode::close)
      subscriber.code = close_code(payload);
  }
  return {};
}

void SubscriberPool::message(Subscriber& subscriber, std::string_view payload, std::int64_t now) {
  if (subscriber.state == State::live) {
    if (subscriber.next_frame == 0) notice(subscriber, payload);  // a baseline's: the first message says where it is
    place(subscriber);
    if (subscriber.early.empty() && subscriber.placed && batch(subscriber, payload, now)) return;
    if (!subscriber.placed && subscriber.early.size() < most_early) {
      subscriber.early.push_back({std::string(payload), now});
      return;
    }
  }
  notice(subscriber, payload);
  if (subscriber.sample && !subscriber.sample->agrees(payload, nullptr)) ++counts_.disagreed;
}

void SubscriberPool::place(Subscriber& subscriber) {
  if (subscriber.placed) return;
  const auto index = timeline_.index_of(subscriber.next_frame);
  if (!index) return;
  subscriber.placed = true;
  subscriber.index = *index;
  for (const Early& early : std::exchange(subscriber.early, {}))
    if (!batch(subscriber, early.bytes, early.when)) notice(subscriber, early.bytes);
}

bool SubscriberPool::batch(Subscriber& subscriber, std::string_view payload, std::int64_t now) {
  const auto* entry = timeline_.match(subscriber.index, payload, now);
  if (entry == nullptr) return false;
  ++subscriber.index;
  ++counts_.delivered;
  lateness_.add(now - entry->batch.due);
  spread_.add(now - entry->earliest);
  if (subscriber.sample && !subscriber.sample->agrees(payload, &entry->batch)) ++counts_.disagreed;
  return true;
}

void SubscriberPool::notice(Subscriber& subscriber, std::string_view payload) {
  const auto notice = timeline_.content().notice(payload);
  if (notice.kind == Notice::Kind::header) return;
  if (notice.kind == Notice::Kind::join) {
    subscriber.placed = false;
    if (subscriber.state == State::joining) {
      subscriber.state = State::live;
      ++live_;
      --pending_;
    } else if (subscriber.next_frame != 0) {
      ++counts_.replaced;
      blame("a join came in the middle: the server took this reader for slow");
    }
    subscriber.next_frame = notice.sequence + 1;
    return;
  }
  if (notice.kind == Notice::Kind::end) return;  // the close that follows counts
  ++counts_.gaps;
  blame(notice.kind == Notice::Kind::error ? "the server sent an error"
                                           : "a message is neither the next batch nor anything else that may come");
}

void SubscriberPool::lose(Subscriber& subscriber, const std::string& why) {
  if (subscriber.state == State::gone) return;
  if (subscriber.state == State::live) {
    --live_;
    ++counts_.disconnected;
  } else {
    --pending_;
    ++counts_.refused;
  }
  blame(subscriber.code != 0 ? "the server closed with " + std::to_string(subscriber.code) : why);
  ++closed_[subscriber.code];
  subscriber.state = State::gone;
  subscriber.socket.close();
  subscriber.rest = {};
}

void SubscriberPool::blame(const std::string& why) {
  if (trouble_.empty()) trouble_ = why;
}

void SubscriberPool::begin_measuring() {
  begin_phase();
  timeline_.content().begin_measuring();
}

void SubscriberPool::begin_phase() {
  counts_.delivered = 0;
  lateness_.clear();
  spread_.clear();
}

}  // namespace semblante::bench

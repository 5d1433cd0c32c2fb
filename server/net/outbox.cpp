#include "server/net/outbox.h"

#include <cerrno>
#include <utility>

#include <sys/socket.h>

namespace semblante::net {

using http::Sent;
using Clock = std::chrono::steady_clock;

namespace {

/// Of the result of send(): how many bytes the kernel accepted; nullopt: the connection is closed.
std::optional<std::size_t> accepted(long result) {
  if (result >= 0) return static_cast<std::size_t>(result);
  // A signal or a kernel without memory does not end a connection: both are temporary.
  for (const int temporary : {EAGAIN, EWOULDBLOCK, EINTR, ENOBUFS, ENOMEM})
    if (result == -temporary) return 0;
  return std::nullopt;
}

}  // namespace

std::optional<std::size_t> Outbox::hand_encrypted(std::string_view bytes) {
  std::size_t handed = 0;
  while (handed < bytes.size()) {
    const auto progress = tls_->write(bytes.substr(handed));
    if (progress.step == TlsSession::Step::wants_write) break;
    if (progress.step != TlsSession::Step::done) return std::nullopt;
    handed += progress.bytes;
  }
  return handed;
}

std::optional<std::size_t> Outbox::hand(std::string_view bytes) {
  if (tls_) return hand_encrypted(bytes);
  const auto count = ::send(descriptor_, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  return accepted(count >= 0 ? count : -errno);
}

void Outbox::fail() {
  closing_ = true;
  close_framed_ = true;
  waiting_.reset();
  ::shutdown(descriptor_, SHUT_RDWR);  // the reader gets the end of the stream and closes the connection
}

bool Outbox::has_room(Kind kind, std::size_t bytes) const {
  if (kind == Kind::control) return true;
  if (kind == Kind::answer)
    return waiting_->items.size() < limits_.answers && waiting_->bytes + bytes <= limits_.answer_bytes;
  return waiting_->state_messages == 0 ||
         (waiting_->state_messages < limits_.messages && waiting_->state_bytes + bytes <= limits_.bytes);
}

void Outbox::count(const Item& item, bool comes) {
  const auto change = [comes](std::size_t& value, std::size_t by) { value = comes ? value + by : value - by; };
  change(waiting_->bytes, item.message->bytes.size());
  if (item.kind != Kind::state) return;
  change(waiting_->state_messages, 1);
  change(waiting_->state_bytes, item.message->bytes.size());
}

Sent Outbox::settle(const http::SharedWire& message, Kind kind, std::optional<std::size_t> handed,
                    std::unique_lock<std::mutex>& lock) {
  if (!handed) {
    fail();
    return Sent::closed;
  }
  const bool whole = *handed == message->bytes.size();
  if (whole && !waiting_) return Sent::handed;
  if (!waiting_) waiting_ = std::make_unique<Waiting>();
  if (!whole) {
    waiting_->items.push_front({message, kind});
    count(waiting_->items.front(), true);
    waiting_->sent_of_first = *handed;
  }
  waiting_->progress = Clock::now();
  ask_for_flush(lock);
  return whole ? Sent::handed : Sent::waits;
}

void Outbox::ask_for_flush(std::unique_lock<std::mutex>& lock) {
  // end_send() asks for what came meanwhile.
  if (armed_ || handing_ != nullptr) return;
  armed_ = true;
  lock.unlock();
  if (const auto owner = owner_.lock()) owner->on_blocked();
}

Sent Outbox::send(const http::SharedWire& message, Kind kind, std::unique_lock<std::mutex>& lock) {
  if (!waiting_ && handing_ == nullptr) return settle(message, kind, hand(message->bytes), lock);
  if (!waiting_) {
    waiting_ = std::make_unique<Waiting>();
    waiting_->progress = Clock::now();
  }
  if (!has_room(kind, message->bytes.size())) return Sent::refused;
  waiting_->items.push_back({message, kind});
  count(waiting_->items.back(), true);
  ask_for_flush(lock);
  return Sent::waits;
}

Sent Outbox::send(const http::SharedWire& message, http::Purpose purpose) {
  std::unique_lock lock(mutex_);
  if (descriptor_ < 0 || closing_) return Sent::closed;
  return send(message, purpose == http::Purpose::state ? Kind::state : Kind::answer, lock);
}

Sent Outbox::send_control(std::string bytes) {
  constexpr char close_header = '\x88';
  http::WireMessage message;
  message.bytes = std::move(bytes);
  std::unique_lock lock(mutex_);
  if (descriptor_ < 0 || close_framed_) return Sent::closed;
  if (!message.bytes.empty() && message.bytes.front() == close_header) closing_ = close_framed_ = true;
  return send(std::make_shared<const http::WireMessage>(std::move(message)), Kind::control, lock);
}

void Outbox::close(http::CloseReason reason, const http::SharedWire& last) {
  {
    std::unique_lock lock(mutex_);
    if (descriptor_ < 0 || closing_) return;
    closing_ = true;
    if (last) send(last, Kind::control, lock);
  }
  if (const auto owner = owner_.lock()) owner->on_close(reason);
}

Outbox::Flushed Outbox::flush() {
  const std::lock_guard lock(mutex_);
  if (handing_ != nullptr) return Flushed::some;  // for a fraction of a millisecond
  if (descriptor_ < 0 || (close_framed_ && !waiting_)) {
    armed_ = false;
    return descriptor_ < 0 ? Flushed::closed : Flushed::all;
  }
  while (waiting_ && !waiting_->items.empty()) {
    const Item& first = waiting_->items.front();
    const auto rest = std::string_view(first.message->bytes).substr(waiting_->sent_of_first);
    const auto handed = hand(rest);
    if (!handed) {
      fail();
      armed_ = false;
      return Flushed::closed;
    }
    if (*handed > 0) waiting_->progress = Clock::now();
    if (*handed < rest.size()) {
      waiting_->sent_of_first += *handed;
      return Flushed::some;
    }
    if (first.message->lateness)
      first.message->lateness->observe(std::chrono::duration<double>(waiting_->progress - first.message->due).count());
    waiting_->sent_of_first = 0;
    count(first, false);
    waiting_->items.pop_front();
  }
  waiting_.reset();
  armed_ = false;
  return Flushed::all;
}

http::WebSocketSink::SendStep Outbox::begin_send(const http::SharedWire& message, std::mutex& handing) {
  std::unique_lock lock(mutex_);
  if (descriptor_ < 0 || closing_) return {-1, Sent::closed};
  if (tls_ || waiting_) return {-1, send(message, Kind::state, lock)};
  handing_ = &handing;
  return {descriptor_, Sent::refused};
}

Sent Outbox::end_send(const http::SharedWire& message, long result) {
  std::unique_lock lock(mutex_);
  handing_ = nullptr;
  return settle(message, Kind::state, accepted(result), lock);
}

std::size_t Outbox::drop_state() {
  const std::lock_guard lock(mutex_);
  if (!waiting_) return 0;
  auto& items = waiting_->items;
  // Keeps a message that is partly sent, or encrypted already: its frame must be completed.
  const std::size_t kept = waiting_->sent_of_first > 0 || (tls_ && tls_->holds_write()) ? 1 : 0;
  const auto before = items.size();
  std::deque<Item> rest;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i >= kept && items[i].kind == Kind::state)
      count(items[i], false);
    else
      rest.push_back(std::move(items[i]));
  }
  items = std::move(rest);
  const auto dropped = before - items.size();
  // An empty waiting_ is kept until flush(), because the socket is still blocked.
  return dropped;
}

bool Outbox::idle() const {
  const std::lock_guard lock(mutex_);
  return !waiting_ && !armed_ && handing_ == nullptr;
}

std::optional<Clock::time_point> Outbox::stalled_since() const {
  const std::lock_guard lock(mutex_);
  if (!waiting_) return std::nullopt;
  return waiting_->progress;
}

void Outbox::detach() {
  std::unique_ptr<Waiting> forgotten;
  std::unique_lock lock(mutex_);
  while (handing_ != nullptr) {
    auto& handing = *handing_;
    lock.unlock();
    handing.lock();
    handing.unlock();
    lock.lock();
  }
  descriptor_ = -1;
  closing_ = true;
  close_framed_ = true;
  forgotten = std::move(waiting_);
}

void Outbox::finish() {
  if (tls_ && !detached()) tls_->close();
  detach();
  if (const auto owner = owner_.lock()) owner->on_over();
}

bool Outbox::detached() const {
  const std::lock_guard lock(mutex_);
  return descriptor_ < 0;
}

}  // namespace semblante::net

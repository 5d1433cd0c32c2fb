#include "server/net/ring_sender.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <sys/socket.h>

#include "server/log/log.h"
#include "server/net/submission_ring.h"

namespace semblante::net {
namespace {

/// Deliveries by one system call. The connections of a group wait for the last of them before they may be closed.
constexpr std::size_t most_at_once = 64;

class RingSender : public http::GroupSender {
 public:
  explicit RingSender(SubmissionRing ring) : ring_(std::move(ring)) {}

  void send(std::span<http::Delivery> group) override {
    for (; !group.empty(); group = group.subspan(std::min(group.size(), most_at_once)))
      send_some(group.first(std::min(group.size(), most_at_once)));
  }

 private:
  /// A delivery whose bytes are handed over by the ring.
  struct Begun {
    http::Delivery* delivery;
    int descriptor;
    std::optional<long> result;  ///< bytes that the kernel accepted, or -errno
  };

  void send_some(std::span<http::Delivery> group) {
    const std::lock_guard handing(handing_);
    begun_.clear();
    std::exception_ptr fault;
    try {
      for (std::size_t i = 0; i < group.size(); ++i) {
        prefetch(group, i + looks_ahead);
        auto& delivery = group[i];
        const auto step = delivery.sink->begin_send(*delivery.message, handing_);
        delivery.sent = step.sent;
        if (step.descriptor >= 0) begun_.push_back({&delivery, step.descriptor, std::nullopt});
      }
    } catch (...) {
      fault = std::current_exception();
    }
    hand_over();
    for (const auto& begun : begun_) {
      try {
        begun.delivery->sent = begun.delivery->sink->end_send(*begun.delivery->message, *begun.result);
      } catch (...) {
        fault = std::current_exception();
      }
    }
    if (fault) std::rethrow_exception(fault);
  }

  void hand_over() {
    if (ring_) {
      for (std::size_t i = 0; i < begun_.size(); ++i)
        ring_->add_send(begun_[i].descriptor, (*begun_[i].delivery->message)->bytes, i);
      const int error = ring_->submit([this](std::size_t i, long result) { begun_[i].result = result; });
      if (error != 0) {
        log::warning(std::string("messages are sent one by one from now on: io_uring: ") + std::strerror(error));
        ring_.reset();
      }
    }
    for (auto& begun : begun_) {
      if (begun.result) continue;
      const auto& bytes = (*begun.delivery->message)->bytes;
      const auto count = ::send(begun.descriptor, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
      begun.result = count >= 0 ? count : -errno;
    }
  }

  std::mutex handing_;  ///< held from begin_send() to end_send()
  std::optional<SubmissionRing> ring_;
  std::vector<Begun> begun_;
};

}  // namespace

std::unique_ptr<http::GroupSender> make_group_sender() {
  auto ring = SubmissionRing::make(most_at_once);
  if (ring) return std::make_unique<RingSender>(std::move(*ring));
  log::debug("messages are sent one by one: io_uring: " + std::string(std::strerror(errno)));
  return std::make_unique<http::GroupSender>();
}

}  // namespace semblante::net

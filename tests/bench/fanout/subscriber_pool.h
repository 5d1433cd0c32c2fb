#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tests/bench/fanout/histogram.h"
#include "tests/bench/fanout/loopback.h"
#include "tests/bench/fanout/timeline.h"
#include "tests/bench/fanout/websocket_wire.h"

namespace semblante::bench {

struct PoolCounts {
  std::uint64_t delivered = 0;     ///< batches
  std::uint64_t gaps = 0;          ///< messages that are not what comes next
  std::uint64_t replaced = 0;      ///< joins in place of batches: the server took this one for slow
  std::uint64_t disconnected = 0;  ///< by the server, unasked
  std::uint64_t refused = 0;       ///< handshakes and hellos
  std::uint64_t disagreed = 0;     ///< samples whose own decoder saw something else
};

/// Many subscribers on one epoll loop of the calling thread, as cheap as reading and checking allows.
class SubscriberPool {
 public:
  SubscriberPool(const Endpoint& endpoint, std::string path, Timeline& timeline);
  ~SubscriberPool();
  SubscriberPool(const SubscriberPool&) = delete;
  SubscriberPool& operator=(const SubscriberPool&) = delete;

  /// So many more, each until it may read batches. Ends the program when that takes longer than a minute and a
  /// hundredth of a second each.
  void open(std::size_t count);
  /// So many more connections under way; run_until does the rest.
  void begin(std::size_t count);
  /// The oldest ones go, every second one without a farewell.
  void leave(std::size_t count);
  void run_until(std::chrono::steady_clock::time_point end);
  void run_for(std::chrono::duration<double> time);
  /// Until a batch has been delivered since begin_measuring(): a short time says nothing of a busy machine.
  void run_until_delivered();

  /// From now on deliveries and lateness count anew.
  void begin_measuring();
  /// Starts the counts anew as begin_measuring() does, but keeps the reference times of lateness, so that the lateness
  /// of several phases can be compared.
  void begin_phase();
  [[nodiscard]] const PoolCounts& counts() const { return counts_; }
  /// Against when a batch was due.
  [[nodiscard]] const Histogram& lateness() const { return lateness_; }
  /// Against the first subscriber that had it.
  [[nodiscard]] const Histogram& spread() const { return spread_; }
  /// Subscribers that are connected and read.
  [[nodiscard]] std::size_t live() const { return live_; }
  /// Close codes that came, with how often; 0: the connection was reset or ended without one.
  [[nodiscard]] const std::map<int, std::uint64_t>& closed() const { return closed_; }
  /// The first thing that went wrong, in words.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }

 private:
  enum class State : std::uint8_t { connecting, securing, upgrading, joining, live, gone };
  struct Early {
    std::string bytes;
    std::int64_t when;
  };
  struct Subscriber {
    Socket socket;
    State state = State::connecting;
    int code = 0;                  ///< of the close frame
    std::uint64_t next_frame = 0;  ///< where it goes on; 0: the first message says
    std::uint64_t index = 0;       ///< of the next batch, once `placed`
    bool placed = false;
    std::string rest;          ///< of a message that has not come whole
    std::vector<Early> early;  ///< batches whose predecessors no one has had yet
    std::unique_ptr<Content::Sample> sample;
  };

  void ready(std::size_t number, std::uint32_t events);
  void connected(Subscriber& subscriber, std::size_t number);
  void secure(Subscriber& subscriber);
  void say(Subscriber& subscriber, std::string_view bytes);
  void take(Subscriber& subscriber, std::string_view bytes, std::int64_t now);
  /// What of the bytes is not yet whole.
  std::string_view take_upgrade(Subscriber& subscriber, std::string_view bytes);
  std::string_view take_frames(Subscriber& subscriber, std::string_view bytes, std::int64_t now);
  void message(Subscriber& subscriber, std::string_view payload, std::int64_t now);
  bool batch(Subscriber& subscriber, std::string_view payload, std::int64_t now);
  void notice(Subscriber& subscriber, std::string_view payload);
  void place(Subscriber& subscriber);
  void lose(Subscriber& subscriber, const std::string& why);
  void blame(const std::string& why);

  const Endpoint endpoint_;
  const std::string path_, upgrade_;
  Timeline& timeline_;
  Socket epoll_;
  std::vector<Subscriber> subscribers_;
  std::size_t left_ = 0;  ///< of those at the front, by leave()
  std::size_t live_ = 0, pending_ = 0;
  std::vector<char> buffer_;
  PoolCounts counts_;
  Histogram lateness_, spread_;
  std::map<int, std::uint64_t> closed_;
  std::string trouble_;
};

}  // namespace semblante::bench

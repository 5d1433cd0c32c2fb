#include "tests/bench/fanout/attacks.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <random>
#include <thread>

#include "protocol/cpp/messages.h"
#include "tests/bench/fanout/subscriber_pool.h"
#include "tests/bench/fanout/websocket_wire.h"

namespace semblante::bench {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using std::chrono::seconds;

/// The server's limits are 10 s; a busy machine gets more.
constexpr seconds time_limit{120};

/// A connection that misbehaves, and what it is told.
class Wrongdoer {
 public:
  explicit Wrongdoer(Socket socket) : socket_(std::move(socket)) {}

  void say(std::string_view bytes) {
    if (!ended_ && socket_.send(bytes) < 0 && errno != EAGAIN) listen();
  }
  /// Reads what there is.
  void listen() {
    char buffer[16 * 1024];
    while (!ended_) {
      const ssize_t size = socket_.receive(buffer, sizeof buffer);
      if (size < 0 && errno == EAGAIN) break;
      if (size <= 0)
        ended_ = true;
      else
        received_.append(buffer, static_cast<std::size_t>(size));
    }
    FrameHead head;
    while (read_head(received_, head) == HeadState::complete &&
           received_.size() >= head.head_bytes + head.payload_bytes) {
      const auto payload = std::string_view(received_).substr(head.head_bytes, head.payload_bytes);
      if (head.opcode == Opcode::close) code_ = close_code(payload);
      if (head.opcode == Opcode::binary && !payload.empty() &&
          static_cast<std::uint8_t>(payload.front()) == MessageTraits<StreamError>::type)
        ++errors_;
      received_.erase(0, head.head_bytes + head.payload_bytes);
    }
  }
  [[nodiscard]] bool ended() const { return ended_; }
  /// Told to go, by a close frame or without.
  [[nodiscard]] bool sent_away() const { return ended_ || code_ != 0; }
  [[nodiscard]] int code() const { return code_; }
  [[nodiscard]] std::size_t errors() const { return errors_; }

 private:
  Socket socket_;
  std::string received_;
  bool ended_ = false;
  int code_ = 0;
  std::size_t errors_ = 0;
};

using Wrongdoers = std::vector<Wrongdoer>;

template <class Test>
std::size_t count(const Wrongdoers& all, Test test) {
  return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), test));
}

/// Does `step` every `pause` until all have been sent away, or the time is up.
template <class Step>
void until_sent_away(Wrongdoers& all, milliseconds pause, Step step) {
  for (const auto end = Clock::now() + time_limit; Clock::now() < end; std::this_thread::sleep_for(pause)) {
    for (Wrongdoer& one : all) {
      step(one);
      one.listen();
    }
    if (std::all_of(all.begin(), all.end(), [](const Wrongdoer& one) { return one.sent_away(); })) return;
  }
}

std::string some(std::size_t count, std::size_t of, const char* what) {
  return std::to_string(count) + " of " + std::to_string(of) + " " + what;
}

void expect_all(Outcome& outcome, std::size_t found, std::size_t of, const char* what) {
  outcome.words += (outcome.words.empty() ? "" : ", ") + some(found, of, what);
  if (found != of) outcome.broken.push_back("only " + some(found, of, what));
}

Outcome slow_handshakes(const Endpoint& endpoint, const std::string& path, std::size_t number) {
  const auto text = upgrade_request(endpoint.authority(), path, binary_subprotocol);
  Wrongdoers all;
  for (std::size_t i = 0; i < number; ++i) all.emplace_back(connect_to(endpoint));
  std::size_t at = 0;
  until_sent_away(all, milliseconds(250), [&, round = std::size_t{0}](Wrongdoer& one) mutable {
    at = round++ / number;
    if (at < text.size() - 4) one.say(text.substr(at, 1));
  });
  Outcome outcome;
  expect_all(outcome, count(all, [](const Wrongdoer& one) { return one.sent_away(); }), number, "closed in time");
  return outcome;
}

Outcome silent_subscribers(const Endpoint& endpoint, const std::string& path, std::size_t number) {
  std::vector<Socket> mute;  // half open: not even a request; the limit of an idle connection is longer than this runs
  for (std::size_t i = 0; i < number; ++i) mute.push_back(connect_to(endpoint));
  Wrongdoers all;
  for (std::size_t i = 0; i < number; ++i) all.emplace_back(open_websocket(endpoint, path, binary_subprotocol));
  until_sent_away(all, milliseconds(100), [](Wrongdoer&) {});
  Outcome outcome;
  expect_all(outcome, count(all, [](const Wrongdoer& one) { return one.code() == 1008; }), number,
             "without hello closed with 1008");
  return outcome;
}

Outcome garbage(const Endpoint& endpoint, const std::string& path, std::size_t number,
                const std::atomic<bool>& enough) {
  std::mt19937 random(1);
  const auto noise = [&](std::uint8_t first) {
    std::string text(1 + random() % 200, '\0');
    for (char& c : text) c = static_cast<char>(random());
    text.front() = static_cast<char>(first);
    return text;
  };
  // Frames, a keyframe, and what no version knows.
  constexpr std::uint8_t kinds[] = {MessageTraits<Frames>::type, MessageTraits<Keyframe>::type, 0xfe};
  Wrongdoers polite, rude;
  const auto hello = hello_frame(Coding::packed);
  for (std::size_t i = 0; i < number; ++i) {
    polite.emplace_back(open_websocket(endpoint, path, binary_subprotocol));
    polite.back().say(hello);
    rude.emplace_back(open_websocket(endpoint, path, binary_subprotocol));
    rude.back().say(hello);
  }
  // At least one round, so that there is something to be answered.
  do {
    for (Wrongdoer& one : polite) {
      one.say(client_frame(Opcode::binary, noise(kinds[random() % 3])));
      one.listen();
    }
    // All bits of the first byte: a reserved opcode with reserved flags.
    for (Wrongdoer& one : rude) {
      one.say(noise(0xff));
      one.listen();
    }
    std::this_thread::sleep_for(milliseconds(50));
  } while (!enough);
  until_sent_away(rude, milliseconds(20), [](Wrongdoer&) {});
  for (const auto end = Clock::now() + time_limit; Clock::now() < end; std::this_thread::sleep_for(milliseconds(20))) {
    for (Wrongdoer& one : polite) one.listen();
    if (std::all_of(polite.begin(), polite.end(), [](const Wrongdoer& one) { return one.errors() > 0; })) break;
  }
  Outcome outcome;
  expect_all(outcome, count(polite, [](const Wrongdoer& one) { return one.errors() > 0 && !one.sent_away(); }), number,
             "with unreadable messages told so and kept");
  expect_all(outcome, count(rude, [](const Wrongdoer& one) { return one.sent_away(); }), number,
             "with no WebSocket frames closed");
  return outcome;
}

Outcome oversized(const Endpoint& endpoint, const std::string& path, std::size_t number) {
  const auto message = client_frame(Opcode::binary, std::string(max_binary_message_bytes + 1, 'x'));
  Wrongdoers all;
  for (std::size_t i = 0; i < number; ++i) {
    all.emplace_back(open_websocket(endpoint, path, binary_subprotocol));
    all.back().say(hello_frame(Coding::packed));
    all.back().say(message);
  }
  until_sent_away(all, milliseconds(20), [](Wrongdoer&) {});
  Outcome outcome;
  // A reset may overtake the close frame when the rest of the message lies unread.
  expect_all(outcome, count(all, [](const Wrongdoer& one) { return one.code() == 1009 || one.ended(); }), number,
             "closed (1009 or reset)");
  return outcome;
}

Outcome flood(SemblanteServer& server, const std::atomic<bool>& enough) {
  Feed feed;
  feed.messages_per_second = 500.0;
  feed.frames_per_message = 10;  // 5,000 frames a second, where 500 are the limit
  SendTimes sent(1'000'000);
  const auto path = server.make_stream(0);
  const auto begin = Clock::now();
  std::uint64_t throttled = 0, frames = 0;
  bool lost = false;
  {
    const Publisher publisher(server.endpoint(), path, feed, sent);
    const auto end = begin + time_limit;
    while (Clock::now() < end && (!enough || publisher.throttled() == 0) && !publisher.lost())
      std::this_thread::sleep_for(milliseconds(20));
    throttled = publisher.throttled();
    frames = publisher.frames_sent();
    lost = publisher.lost();
  }
  const auto taken = server.stream_number(path, "sequence");
  const double time = std::chrono::duration<double>(Clock::now() - begin).count();
  Outcome outcome;
  outcome.words = std::to_string(taken) + " of " + std::to_string(frames) + " frames taken in " +
                  std::to_string(time).substr(0, 4) + " s, " + std::to_string(throttled) + " messages throttled" +
                  (lost ? ", closed" : "");
  if (throttled == 0) outcome.broken.emplace_back("a publisher of ten times the limit is not told `throttled`");
  if (static_cast<double>(taken) > 2000.0 + 500.0 * (time + 1.0))
    outcome.broken.push_back(std::to_string(taken) + " frames were taken, over 500 a second and 2000 at once");
  return outcome;
}

Outcome storm(const Endpoint& endpoint, const std::string& path, const SendTimes& sent, const Options& options,
              const std::atomic<bool>& enough) {
  constexpr std::size_t at_a_time = 10;
  constexpr milliseconds pause{50};  // 200 a second
  constexpr std::size_t stay = 10;   // pauses, half a second
  Timeline timeline(stream_content(options.coding, sent, options.feed.heavy));
  SubscriberPool pool(endpoint, path, timeline);
  pool.open(1);
  std::size_t came = 0;
  auto due = Clock::now();
  for (std::size_t round = 0; !enough || round < 2 * stay; ++round) {
    pool.begin(at_a_time);
    came += at_a_time;
    due += pause;
    pool.run_until(due);
    if (round >= stay) pool.leave(at_a_time);
  }
  const PoolCounts& counts = pool.counts();
  Outcome outcome;
  outcome.words = std::to_string(came) + " came and left, " + std::to_string(counts.delivered) + " messages read";
  if (counts.refused + counts.gaps + counts.disagreed > 0)
    outcome.broken.push_back(std::to_string(counts.refused) + " were refused, " + std::to_string(counts.gaps) +
                             " gaps; " + pool.trouble());
  return outcome;
}

}  // namespace

std::vector<Attack> attacks(SemblanteServer& server, const std::string& path, const SendTimes& sent,
                            const Options& options) {
  const std::size_t many = options.smoke ? 10 : 100;
  const Endpoint endpoint = server.endpoint();
  return {
      {"a publisher sends ten times what it may",
       [&server](const std::atomic<bool>& enough) { return flood(server, enough); }},
      {"subscribers send garbage",
       [=](const std::atomic<bool>& enough) { return garbage(endpoint, path, many / 2, enough); }},
      {"messages over the limit", [=](const std::atomic<bool>&) { return oversized(endpoint, path, many / 5); }},
      {"200 come and leave a second",
       [=, &sent](const std::atomic<bool>& enough) { return storm(endpoint, path, sent, options, enough); }},
      {"handshakes a byte at a time", [=](const std::atomic<bool>&) { return slow_handshakes(endpoint, path, many); }},
      {"connections that say nothing",
       [=](const std::atomic<bool>&) { return silent_subscribers(endpoint, path, many); }}};
}

}  // namespace semblante::bench

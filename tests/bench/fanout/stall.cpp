// Readers that stop reading: what the others feel of it, and what becomes of those who stopped.

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <optional>
#include <vector>

#include "tests/bench/fanout/median.h"
#include "tests/bench/fanout/target.h"
#include "tests/bench/fanout/verdict.h"

namespace semblante::bench {
namespace {

/// What a connection that was not read ended with, after all that lay in it is read.
enum class Ending : std::uint8_t { open, reset, closed, told_1013 };

/// Reads to the end; `open` when nothing comes for a while and there is none.
Ending ending_of(const Socket& socket) {
  std::string tail;  // the close frame, if it got through, is the last thing there is: 88 0L 03 F5 and words
  char buffer[64 * 1024];
  ssize_t size = 0;
  while ((size = socket.receive_in_time(buffer, sizeof buffer, std::chrono::seconds(10))) > 0) {
    tail.append(buffer, static_cast<std::size_t>(size));
    if (tail.size() > 256) tail.erase(0, tail.size() - 256);
  }
  const auto at = tail.rfind("\x03\xf5");
  if (at != std::string::npos && at >= 2 && tail[at - 2] == '\x88') return Ending::told_1013;
  if (size == 0) return Ending::closed;
  return errno == EAGAIN ? Ending::open : Ending::reset;
}

}  // namespace

int stall(const Options& given) {
  Options options = given;
  if (options.subscribers == 0) options.subscribers = options.smoke ? 100 : 1000;
  if (options.seconds == 0.0) options.seconds = options.smoke ? 1.0 : 8.0;
  if (options.repetitions == 0) options.repetitions = options.smoke ? 1 : 3;
  // Messages of many bytes: a reader of a few hundred bytes a second may stop for minutes before a kernel's buffer is
  // full and anyone can know.
  options.feed.heavy = true;
  options.feed.frames_per_message = std::max<std::size_t>(options.feed.frames_per_message, 8);
  const auto count = std::max<std::size_t>(
      1, static_cast<std::size_t>(options.stalled * static_cast<double>(options.subscribers) + 0.5));

  SemblanteServer server(options);
  FedStream stream(server, options, 3600.0);
  SubscriberPool pool(server.endpoint(), stream.path, stream.timeline);
  pool.open(options.subscribers);
  pool.run_for(std::chrono::duration<double>(options.smoke ? 0.3 : 2.0));
  std::printf("%zu subscribers, %.0f messages/s; %zu more stop reading\n", pool.live(),
              options.feed.messages_per_second, count);
  std::printf(
      "| round | all read | %zu stopped | ratio of p99 | closed 1013 | closed | reset | still open | MiB before, most "
      "|\n",
      count);
  std::printf("|---|---|---|---|---|---|---|---|---|\n");

  Verdict verdict;
  std::vector<double> ratios;
  const auto hello = hello_frame(options.coding);
  for (int round = 0; round < options.repetitions; ++round) {
    pool.begin_measuring();
    pool.run_for(std::chrono::duration<double>(options.seconds));
    const Histogram quiet = pool.lateness();

    std::vector<Socket> stopped;
    for (std::size_t i = 0; i < count; ++i) {
      stopped.push_back(
          open_websocket(server.endpoint(), stream.path, subprotocol_of(options.coding), small_receive_buffer));
      send_all(stopped.back(), hello);
      pool.run_for(std::chrono::milliseconds(1));
    }
    const auto before = resident_bytes(server.pid());
    std::size_t most = before;
    const auto watch = [&](double seconds) {
      const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
      while (std::chrono::steady_clock::now() < end) {
        pool.run_for(std::chrono::milliseconds(100));
        most = std::max(most, resident_bytes(server.pid()));
      }
    };
    pool.begin_measuring();
    watch(options.seconds);
    const Histogram troubled = pool.lateness();

    // The limit is 5 s of reading nothing, then 5 s for the farewell; a busy machine gets more.
    // Their end of the connection cannot tell: the farewell lies behind what they did not read.
    const auto remaining = [&] { return server.stream_number(stream.path, "subscribers"); };
    for (int wait = 0; wait < 240 && remaining() > pool.live(); ++wait) watch(0.5);
    const auto left = remaining();
    verdict.expect(left == pool.live(), std::to_string(left - pool.live()) + " stopped readers are still subscribed");
    std::size_t endings[4] = {};
    for (const Socket& socket : stopped) ++endings[static_cast<std::size_t>(ending_of(socket))];
    const double ratio =
        quiet.percentile_ms(0.99) > 0.0 ? troubled.percentile_ms(0.99) / quiet.percentile_ms(0.99) : 0.0;
    ratios.push_back(ratio);
    std::printf("| %d | %s | %s | %.3f | %zu | %zu | %zu | %zu | %.1f, %.1f |\n", round + 1, words(quiet).c_str(),
                words(troubled).c_str(), ratio, endings[3], endings[2], endings[1], endings[0],
                static_cast<double>(before) / 1048576.0, static_cast<double>(most) / 1048576.0);
    std::fflush(stdout);
    verdict.expect(endings[0] == 0, std::to_string(endings[0]) + " readers that stopped are still connected");
    // What the limits allow one subscriber to hold: the messages that may wait for it.
    verdict.expect(server.pid() == 0 || most <= before + count * 64 * 8192 + (std::size_t{16} << 20U),
                   "the server's memory grew by " + std::to_string((most - before) >> 20U) + " MiB");
  }
  verdict.expect_whole(pool, stream.timeline, "those who read");
  const double ratio = median(ratios);
  std::printf("p99 of the others with %zu stopped readers: x %.3f (median)\n", count, ratio);
  if (!options.smoke) verdict.expect(ratio <= 1.1, "p99 of the others moved by more than a tenth");
  return verdict.status();
}

}  // namespace semblante::bench

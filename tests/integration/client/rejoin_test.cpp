// Connections killed at random, and what the client shows after each rejoin beside one that was never interrupted.

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <iostream>
#include <map>
#include <random>
#include <thread>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clients/native/client/face_package.h"
#include "clients/native/client/kernel_frame.h"
#include "clients/native/client/live_stream.h"
#include "tests/integration/client/sample_server.h"
#include "tests/support/stream_speaker.h"
#include "tests/support/tcp_proxy.h"
#include "tests/support/wait.h"

namespace semblante::testing {
namespace {

using client::LiveStream;
using client::LiveStreamOptions;
using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

constexpr const char* stream_name = "killed";
constexpr int kills_each = 200;
constexpr int messages_per_second = 100;
constexpr int most_frames_per_message = 3;
/// The server makes up for no longer gap: StreamLimits::resumed_frames.
constexpr std::uint64_t most_frames_made_up_for = 1024;
/// And for such a one always: in no form are these more than StreamLimits::resumed_bytes.
constexpr std::uint64_t frames_made_up_for = 512;
/// A frame every so many ms of the publisher's clock.
constexpr std::uint64_t frame_spacing = 5;

struct Named {
  std::uint64_t epoch = 0, sequence = 0;
  auto operator<=>(const Named&) const = default;
};

struct Known {
  std::uint64_t media_time = 0;
  FaceFrame state;
};

/// The beginning of one connection, as far as it came.
struct Joined {
  std::optional<ResumePoint> resume;
  Header header;
  std::optional<std::uint64_t> keyframe, next;
};

/// Everything that one client was told.
class Told {
 public:
  std::map<Named, Known> frames;
  std::vector<Joined> joins;
  std::vector<std::string> faults;
  std::uint64_t messages = 0;

  [[nodiscard]] std::uint64_t epoch() const { return joins.empty() ? 0 : joins.back().header.epoch; }
  [[nodiscard]] std::uint64_t last() const { return last_; }

  void take(const runtime::Event& event, LiveStream& stream) {
    const Frames& newest = stream.machine().newest();
    if (event.type == SEMBLANTE_EVENT_HEADER) {
      joins.push_back({stream.sent_resume(), *stream.header(), {}, {}});
    } else if (event.type == SEMBLANTE_EVENT_KEYFRAME) {
      if (!joins.back().keyframe) {
        joins.back().keyframe = newest.sequence;
      }
      know(newest.sequence, newest.media_time, newest.frames.front().state);
      last_ = newest.sequence;
      ++messages;
    } else if (event.type == SEMBLANTE_EVENT_FRAMES) {
      if (!joins.back().next) {
        joins.back().next = newest.sequence;
      }
      if (newest.sequence != last_ + 1) {
        fault("after " + std::to_string(last_) + " came " + std::to_string(newest.sequence));
      }
      for (std::size_t i = 0; i < newest.frames.size(); ++i) {
        know(newest.sequence + i, newest.media_time + newest.frames[i].time, newest.frames[i].state);
      }
      last_ = newest.sequence + newest.frames.size() - 1;
      ++messages;
    } else if (event.type == SEMBLANTE_EVENT_REFUSED) {
      fault("the server says: " + event.error->message);
    }
  }

 private:
  void fault(const std::string& words) {
    if (faults.size() < 10) faults.push_back(words);
  }
  void know(std::uint64_t sequence, std::uint64_t media_time, const FaceFrame& state) {
    if (sequence == 0) return;  // before the first frame
    const auto [at, is_new] = frames.try_emplace({joins.back().header.epoch, sequence}, Known{media_time, state});
    if (!is_new && (at->second.media_time != media_time || !(at->second.state == state))) {
      fault("frame " + std::to_string(sequence) + " was at " + std::to_string(at->second.media_time) + ", is at " +
            std::to_string(media_time) + (at->second.state == state ? "" : " and is another face"));
    }
  }
  std::uint64_t last_ = 0;
};

/// A client and what it was told. Lives through the end of its stream, as long as another of that name is made.
class Watcher {
 public:
  Watcher(const client::Url& url, LiveStreamOptions options) : url_(url), options_(options) { begin(); }

  void pump(milliseconds time) {
    const auto deadline = Clock::now() + time;
    while (Clock::now() < deadline) {
      const auto left = std::chrono::ceil<milliseconds>(deadline - Clock::now());
      auto event = stream_->next(std::min(left, milliseconds(50)));
      if (!event) {  // no such stream just now
        std::this_thread::sleep_for(milliseconds(5));
        begin();
      } else if (event->type != SEMBLANTE_EVENT_NONE) {
        told.take(*event, *stream_);
        if (event->type == SEMBLANTE_EVENT_END) begin();
        return;
      }
    }
  }
  /// False when it takes unreasonably long.
  bool pump_until(const std::function<bool()>& done) {
    return eventually(
        [&] {
          if (!done()) pump(milliseconds(20));
          return done();
        },
        milliseconds(0));
  }

  Told told;

 private:
  void begin() {
    if (stream_) options_.resume = stream_->resume();
    stream_.emplace(url_, stream_name, options_);
  }
  client::Url url_;
  LiveStreamOptions options_;
  std::optional<LiveStream> stream_;
};

LiveStreamOptions quick(bool json, std::uint64_t seed) {
  LiveStreamOptions options;
  options.socket.json = json;
  options.first_pause = milliseconds(2);
  options.longest_pause = milliseconds(40);
  options.seed = seed;
  return options;
}

/// Publishes a face that never stands still until told to stop, to whatever stream has the name; to each epoch only
/// once the uninterrupted client is there.
void publish(const client::Url& url, const std::atomic<std::uint64_t>& watched_epoch, const std::atomic<bool>& stop) {
  std::mt19937_64 random(5);
  FaceFrame face;
  std::uint64_t clock = 1000;
  auto next = Clock::now();
  while (!stop) {
    Hello hello;
    hello.role = StreamRole::publish;
    auto stream = StreamSpeaker::connect(url, stream_name, hello);
    bool first = true;
    while (stream && !stop) {
      const auto message = stream->next(milliseconds(0));
      if (!message || (*message && std::holds_alternative<End>(**message))) break;
      if (first && (!*message || !std::holds_alternative<Header>(**message))) continue;
      if (first) {
        const auto epoch = std::get<Header>(**message).epoch;
        while (watched_epoch != epoch && !stop) std::this_thread::sleep_for(milliseconds(1));
      }
      Frames frames{0, clock, {}};
      const std::size_t count = first ? 1 : 1 + random() % most_frames_per_message;
      for (std::size_t i = 0; i < count; ++i) {
        for (const std::size_t fap : {3, 4, 19, 23, 48, 49, 59, 60}) {
          face.level[fap] =
              static_cast<std::int16_t>(std::clamp<int>(face.level[fap] + static_cast<int>(random() % 9) - 4, -60, 60));
        }
        face.viseme = {static_cast<std::uint8_t>(random() % 15), 0, static_cast<std::uint8_t>(random() % 64)};
        frames.frames.push_back({static_cast<std::uint32_t>(i * frame_spacing), face});
      }
      const auto sent = first ? stream->send(Keyframe{0, clock, face}) : stream->send(frames);
      if (!sent) break;
      first = false;
      clock += most_frames_per_message * frame_spacing;
      next = std::max(next + milliseconds(1000 / messages_per_second), Clock::now() - milliseconds(50));
      std::this_thread::sleep_until(next);
    }
    std::this_thread::sleep_for(milliseconds(5));
  }
}

std::uint64_t newest_frame(const SampleServer& server) {
  const auto stream = server.stream(stream_name);
  return stream.is_object() ? stream.value("sequence", std::uint64_t{0}) : 0;
}

/// Kills a client's connections in every way there is; `for_long`: longer than what is made up for.
void kill_and_come_back(const SampleServer& server, Watcher& victim, TcpProxy& proxy, std::mt19937_64& random,
                        bool for_long) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  const std::uint64_t messages = victim.told.messages + 1 + below(4);
  EXPECT_TRUE(victim.pump_until([&] { return victim.told.messages >= messages; })) << "no more frames come";
  const std::size_t joins = victim.told.joins.size();
  const std::size_t way = below(100);
  if (for_long) {
    proxy.refuse(true);
    proxy.cut();
    const auto enough = newest_frame(server) + most_frames_made_up_for + 1 + below(200);
    EXPECT_TRUE(eventually([&] { return newest_frame(server) >= enough; }, milliseconds(50))) << "no more is published";
    proxy.refuse(false);
  } else if (way < 46) {
    proxy.cut();
  } else if (way < 70) {  // somewhere in a message
    proxy.cut_after(1 + below(300));
  } else {  // in the handshake, the header, the keyframe or what is made up for
    proxy.cut();
    proxy.cut_after(1 + below(1500));
  }
  EXPECT_TRUE(victim.pump_until([&] {
    return victim.told.joins.size() > joins && victim.told.joins.back().keyframe && victim.told.joins.back().next;
  })) << "it does not come back";
}

struct Truth {
  std::size_t rejoins = 0, recovered = 0, other_epochs = 0;
};

/// `recovered` says true exactly when all frames after the resume point follow.
Truth expect_truth(const Told& told) {
  Truth truth;
  for (const Joined& join : told.joins) {
    if (!join.resume) continue;
    // The header alone tells of another epoch: a connection may be killed right after it.
    if (join.resume->epoch != join.header.epoch) {
      ++truth.rejoins;
      ++truth.other_epochs;
      EXPECT_FALSE(join.header.recovered) << "of another epoch";
      continue;
    }
    if (!join.keyframe) continue;
    ++truth.rejoins;
    if (join.header.recovered) {
      ++truth.recovered;
      EXPECT_EQ(*join.keyframe, join.resume->sequence);
    } else {
      EXPECT_GT(*join.keyframe, join.resume->sequence + frames_made_up_for) << "the server could make up for that";
    }
    if (join.next) {
      EXPECT_EQ(*join.next, *join.keyframe + 1);
    }
  }
  return truth;
}

class Faces {
 public:
  explicit Faces(const SampleServer& server) {
    auto face = client::load_face(server.http(), "sample");
    if (!face) {
      ADD_FAILURE() << face.error().message;
      return;
    }
    face_.emplace(*std::move(face));
    glm::vec3 low = face_->model().positions[0];
    glm::vec3 high = low;
    for (const glm::vec3& p : face_->model().positions) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    quantum_ = std::max({high.x - low.x, high.y - low.y, high.z - low.z}) / 16383.0F;
  }

  /// Of the mesh, as Draco stores it.
  [[nodiscard]] float quantum() const { return quantum_; }

  /// What a client that knows these frames shows at a media time between the first and the last of an epoch.
  std::vector<glm::vec3> at(const std::map<std::uint64_t, FaceFrame>& frames, double media_time) {
    const auto after = frames.upper_bound(static_cast<std::uint64_t>(media_time));
    EXPECT_TRUE(after != frames.begin() && after != frames.end());
    const auto before = std::prev(after);
    const double share =
        (media_time - static_cast<double>(before->first)) / static_cast<double>(after->first - before->first);
    const auto from = client::to_kernel_frame(before->second, standard_quantizers());
    const auto to = client::to_kernel_frame(after->second, standard_quantizers());
    EXPECT_EQ(semblante_head_set_interpolated(face_->head(), &from, &to, static_cast<float>(share)), SEMBLANTE_OK);
    return face_->positions();
  }

 private:
  std::optional<client::Face> face_;
  float quantum_ = 0;
};

using TimeLines = std::map<std::uint64_t, std::map<std::uint64_t, FaceFrame>>;  ///< by epoch and media time

TimeLines time_lines(const Told& told) {
  TimeLines lines;
  for (const auto& [name, known] : told.frames) lines[name.epoch][known.media_time] = known.state;
  return lines;
}

TEST(Rejoin, TwoHundredKills_EachFormShowsWhatAnUninterruptedClientShows) {
  const SampleServer server;
  server.create_stream(stream_name);
  const client::Url url = *client::parse_url(server.url());
  std::atomic<bool> stop_publishing = false, stop_watching = false;
  std::atomic<std::uint64_t> watched_epoch = 0, watched_frame = 0;
  std::thread publisher([&] { publish(url, watched_epoch, stop_publishing); });
  Watcher reference(url, quick(false, 1));
  std::thread watching([&] {
    while (!stop_watching) {
      reference.pump(milliseconds(50));
      watched_frame = reference.told.last();
      watched_epoch = reference.told.epoch();
    }
  });

  struct Victim {
    const char* name;
    LiveStreamOptions options;
    Told told;
  };
  std::array<Victim, 2> victims = {Victim{"binary", quick(false, 11), {}}, Victim{"JSON", quick(true, 13), {}}};
  // Three times all of them wait for another epoch: the stream goes, and another of its name comes.
  constexpr int epochs = 3;
  std::array<std::atomic<std::size_t>, epochs> waiting{};
  std::atomic<int> replaced = 0;
  std::vector<std::thread> threads;
  for (Victim& victim : victims) {
    threads.emplace_back([&] {
      ProxyOptions network;
      network.target_port = static_cast<std::uint16_t>(std::stoi(url.port));
      network.seed = victim.options.seed;
      network.delay = 1;
      network.jitter = 4;
      TcpProxy proxy(network);
      std::mt19937_64 random(victim.options.seed);
      Watcher watcher({url.host, std::to_string(proxy.port()), ""}, victim.options);
      for (int k = 0; k < kills_each && !::testing::Test::HasFailure(); ++k) {
        if (k > 0 && k % (kills_each / (epochs + 1)) == 0) {
          const int part = k / (kills_each / (epochs + 1));
          const auto epoch = watcher.told.epoch();
          ++waiting.at(static_cast<std::size_t>(part - 1));
          EXPECT_TRUE(watcher.pump_until([&] {
            return ::testing::Test::HasFailure() ||
                   (replaced >= part && watcher.told.epoch() != epoch && watcher.told.joins.back().next);
          })) << "no other epoch comes";
        }
        kill_and_come_back(server, watcher, proxy, random, k % 50 == 25);
      }
      victim.told = std::move(watcher.told);
    });
  }
  for (auto& each : waiting) {
    while (each < victims.size() && !::testing::Test::HasFailure()) std::this_thread::sleep_for(milliseconds(5));
    const auto gone = server.http().send({"DELETE", "/v1/streams/" + std::string(stream_name), "", "", {}});
    EXPECT_TRUE(gone && gone->status == 204) << (gone ? gone->body : gone.error().message);
    server.create_stream(stream_name);
    ++replaced;
  }
  for (std::thread& each : threads) each.join();
  stop_publishing = true;
  publisher.join();
  const auto newest = newest_frame(server);
  EXPECT_TRUE(eventually([&] { return watched_frame >= newest; })) << "the uninterrupted one does not have all of it";
  stop_watching = true;
  watching.join();

  EXPECT_THAT(reference.told.faults, ::testing::IsEmpty());
  const TimeLines whole = time_lines(reference.told);
  Faces faces(server);
  for (const Victim& victim : victims) {
    SCOPED_TRACE(victim.name);
    EXPECT_THAT(victim.told.faults, ::testing::IsEmpty());
    const Truth truth = expect_truth(victim.told);
    std::size_t unlike = 0, unknown = 0;
    for (const auto& [name, known] : victim.told.frames) {
      const auto same = reference.told.frames.find(name);
      unknown += same == reference.told.frames.end() ? 1 : 0;
      if (same != reference.told.frames.end() &&
          (same->second.media_time != known.media_time || !(same->second.state == known.state))) {
        ++unlike;
      }
    }
    EXPECT_EQ(unlike, 0U) << "frames of one number are one face at one time";
    EXPECT_EQ(unknown, 0U) << "frames that the uninterrupted one never had";

    // The face shortly after each rejoin, half way between two frames.
    const TimeLines partial = time_lines(victim.told);
    std::size_t compared = 0;
    float farthest = 0, moved = 0;
    for (const Joined& join : victim.told.joins) {
      if (!join.keyframe || !join.next) continue;
      const auto first = victim.told.frames.find({join.header.epoch, *join.next});
      const auto line = whole.find(join.header.epoch);
      if (first == victim.told.frames.end() || line == whole.end()) continue;
      const auto& mine = partial.at(join.header.epoch);
      const double when = static_cast<double>(first->second.media_time) + 0.5 * static_cast<double>(frame_spacing);
      const auto inside = [&](const std::map<std::uint64_t, FaceFrame>& frames) {
        return static_cast<double>(frames.begin()->first) < when && when < static_cast<double>(frames.rbegin()->first);
      };
      const double earlier = when - 3 * static_cast<double>(frame_spacing);
      if (!inside(mine) || !inside(line->second) || earlier < static_cast<double>(line->second.begin()->first))
        continue;
      const auto here = faces.at(mine, when);
      const auto there = faces.at(line->second, when);
      const auto before = faces.at(line->second, earlier);
      for (std::size_t v = 0; v < here.size(); ++v) {
        farthest = std::max(farthest, glm::length(here[v] - there[v]));
        moved = std::max(moved, glm::length(here[v] - before[v]));
      }
      ++compared;
    }
    EXPECT_LE(farthest, faces.quantum());
    EXPECT_GT(moved, 20 * faces.quantum()) << "a face that stands still shows nothing";
    EXPECT_GE(compared, static_cast<std::size_t>(kills_each) * 8 / 10);
    EXPECT_GE(truth.rejoins, static_cast<std::size_t>(kills_each));
    EXPECT_GT(truth.recovered, 0U);
    EXPECT_GE(truth.rejoins - truth.recovered - truth.other_epochs, 4U) << "of gaps that are too long";
    EXPECT_GE(truth.other_epochs, static_cast<std::size_t>(epochs));
    std::cout << victim.name << ": " << truth.rejoins << " rejoins, " << truth.recovered << " recovered, "
              << truth.other_epochs << " to another epoch; " << compared << " faces compared, at most "
              << farthest / faces.quantum() << " quanta apart\n";
  }
}

}  // namespace
}  // namespace semblante::testing

// bench_runtime FOLDER [FACES]: what a client pays for faces that follow streams: one face 60 times a second, and many
// (1000) in one process. FOLDER holds mesh.drc, weights and rig.json. Times are processor time of the thread, the best
// of several.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <malloc.h>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "clients/runtime/semblante.h"
#include "protocol/cpp/packed_codec.h"
#include "tests/bench/coding/training.h"
#include "tests/support/frame_encoder.h"
#include "tests/support/thread_time.h"

namespace semblante::bench {
namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr double display = 1000.0 / 60;  // ms
constexpr double batch = 100;            // ms between two messages, three frames in each
constexpr int seconds = 10;

void check(bool holds, const char* what) {
  if (!holds) throw std::runtime_error(what);
}

/// ms of `work`, the best of `rounds`.
double best(int rounds, const std::function<void()>& work) {
  double least = 1e300;
  for (int i = 0; i < rounds; ++i) {
    const double begin = test::thread_cpu_ms();
    work();
    least = std::min(least, test::thread_cpu_ms() - begin);
  }
  return least;
}

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path + " cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

struct Package {
  std::string mesh, weights, rig;
  explicit Package(const std::string& folder)
      : mesh(read(folder + "/mesh.drc")), weights(read(folder + "/weights")), rig(read(folder + "/rig.json")) {}
  [[nodiscard]] semblante_head* head(std::uint32_t flags) const {
    semblante_package package{};
    package.size = sizeof(package);
    package.mesh_drc = reinterpret_cast<const std::uint8_t*>(mesh.data());
    package.mesh_drc_size = mesh.size();
    package.weights = reinterpret_cast<const std::uint8_t*>(weights.data());
    package.weights_size = weights.size();
    package.rig_json = rig.data();
    package.rig_json_size = rig.size();
    semblante_head_options options{};
    options.size = sizeof(options);
    options.flags = flags;
    semblante_head* head = nullptr;
    semblante_error error{};
    if (semblante_head_create(&package, &options, &head, &error) != SEMBLANTE_OK) {
      throw std::runtime_error(std::string(error.where) + ": " + error.message);
    }
    return head;
  }
};

/// The messages of one stream: header, keyframe, then a batch of three frames each 100 ms.
struct Speech {
  std::vector<Bytes> messages;
  std::size_t bytes = 0;
  explicit Speech(Trace trace) {
    check(trace.frames.size() >= 30 * seconds, "the trace is too short");
    trace.frames.resize(30 * seconds);
    for (std::size_t i = 0; i < trace.frames.size(); ++i)
      trace.frames[i].time = static_cast<std::uint32_t>(i * 1000 / 30);
    Header header;
    header.stream = "bench";
    header.epoch = 7;
    header.fps_hint = 30;
    header.batch_interval = static_cast<std::uint64_t>(batch);
    messages.push_back(FrameEncoder().encode(header));
    PackedEncoder encoder(first_frame(trace));
    messages.push_back(encoder.keyframe());
    for (const Frames& frames : batches(trace, 3)) messages.push_back(encoder.encode(frames));
    for (std::size_t i = 2; i < messages.size(); ++i) bytes += messages[i].size();
  }
};

/// One stream with its player, and how it is driven.
struct Follower {
  semblante_stream* stream = nullptr;
  semblante_player* player = nullptr;
  std::size_t next = 2;
  explicit Follower(const Speech& speech, bool plays, double now) {
    check(semblante_stream_create(nullptr, &stream, nullptr) == SEMBLANTE_OK, "stream");
    if (plays) {
      check(semblante_player_create(nullptr, &player, nullptr) == SEMBLANTE_OK, "player");
      check(semblante_player_follow(player, stream) == SEMBLANTE_OK, "follow");
    }
    semblante_stream_start(stream, now);
    semblante_stream_opened(stream, now);
    receive(speech.messages[0], now);
    receive(speech.messages[1], now);
  }
  Follower(const Follower&) = delete;
  Follower& operator=(const Follower&) = delete;
  ~Follower() {
    semblante_player_destroy(player);
    semblante_stream_destroy(stream);
  }
  void receive(const Bytes& message, double now) const {
    semblante_stream_receive(stream, message.data(), message.size(), now);
    semblante_event event{};
    event.size = sizeof(event);
    while (semblante_stream_next_event(stream, &event) != 0) check(event.type != SEMBLANTE_EVENT_FAULT, "a fault");
    std::size_t size = 0;
    while (semblante_stream_take_bytes(stream, &size) != nullptr) {
    }
  }
  /// What has arrived since the last display frame.
  void receive_due(const Speech& speech, double since) {
    while (next < speech.messages.size() && since >= batch * static_cast<double>(next - 1)) {
      receive(speech.messages[next++], 1000 + since);
    }
    semblante_stream_tick(stream, 1000 + since);
  }
};

/// Eq. 7 as it is written, without motions of eyes, lids, tongue and head: the plain baseline.
void naive(const semblante_face& face, const semblante_pose& pose, float* out) {
  for (std::uint32_t v = 0; v < face.vertex_count; ++v) {
    float sum[3] = {0, 0, 0};
    for (std::uint32_t r = face.row_offsets[v]; r < face.row_offsets[v + 1]; ++r) {
      for (int k = 0; k < 3; ++k) sum[k] += face.row_weights[r] * pose.fp[3 * face.row_points[r] + k];
    }
    for (int k = 0; k < 3; ++k) out[3 * v + k] = face.rest[3 * v + k] + sum[k];
  }
}

void one_face(const Package& package, const char* name, const Speech& speech) {
  semblante_head* head = package.head(0);
  const std::size_t numbers = std::size_t{semblante_head_vertex_count(head)} * 3;
  std::vector<float> positions(numbers);
  std::vector<float> copy(numbers);
  std::vector<float> normals(numbers);
  std::vector<semblante_pose> poses;
  const int frames = static_cast<int>(seconds * 1000 / display);
  const auto follow = [&](const std::function<void()>& shown) {
    Follower follower(speech, true, 1000);
    for (int i = 0; i < frames; ++i) {
      const double since = i * display;
      follower.receive_due(speech, since);
      if (semblante_player_advance(follower.player, 1000 + since, display) == 0) continue;
      semblante_player_show(follower.player, head);
      shown();
    }
  };
  follow([&] { poses.push_back(*semblante_head_pose(head)); });
  check(poses.size() > 500, "too few faces were shown");
  const semblante_face& face = *semblante_head_face(head);
  const double decode = best(7, [&] { follow([] {}); }) / frames;
  const double both =
      best(7, [&] { follow([&] { semblante_head_positions(head, positions.data(), numbers); }); }) / frames;
  const double with_normals = best(5,
                                   [&] {
                                     follow([&] {
                                       semblante_head_positions(head, positions.data(), numbers);
                                       semblante_head_normals(head, positions.data(), normals.data(), numbers);
                                     });
                                   }) /
                              frames;
  const double plain = best(7,
                            [&] {
                              for (const auto& pose : poses) naive(face, pose, copy.data());
                            }) /
                       static_cast<double>(poses.size());
  const double moved = best(7,
                            [&] {
                              for (std::size_t i = 0; i < poses.size(); ++i) {
                                std::memcpy(copy.data(), positions.data(), numbers * sizeof(float));
                                asm volatile("" ::"r"(copy.data()) : "memory");
                              }
                            }) /
                       static_cast<double>(poses.size());
  std::printf("One face of %zu vertices, shown 60 times a second; %s, 30 frames a second, %.1f kbit/s\n\n", numbers / 3,
              name, static_cast<double>(speech.bytes) * 8 / 1000 / seconds);
  std::printf(
      "| per shown face | us | of a core at 60/s | times the naive loop | times memcpy |\n|---|---|---|---|---|\n");
  const auto row = [&](const char* name, double ms) {
    std::printf("| %s | %.2f | %.3f %% | %.2f | %.1f |\n", name, ms * 1000, ms / display * 100, ms / plain, ms / moved);
  };
  row("decode, clock, playout, pose", decode);
  row("... and vertices", both);
  row("... and normals", with_normals);
  row("naive Eq. 7, vertices alone", plain);
  row("memcpy of the vertices", moved);
  std::printf("\n");
  semblante_head_destroy(head);
}

std::size_t memory() { return mallinfo2().uordblks + mallinfo2().hblkhd; }

void many_faces(const Package& package, const Speech& speech, std::size_t count) {
  std::printf("%zu faces in one process, each with a live capture of its own\n\n", count);
  std::printf("| each face has | us a second | faces per core | kB of memory at the end |\n|---|---|---|---|\n");
  struct Kind {
    const char* name;
    bool plays, poses, vertices;
  };
  for (const Kind kind :
       {Kind{"a stream (a recorder)", false, false, false}, Kind{"... and a player", true, false, false},
        Kind{"... and a head whose vertices the GPU moves", true, true, false},
        Kind{"... or a head with vertices", true, true, true}}) {
    const std::size_t faces = kind.vertices ? std::max<std::size_t>(count / 20, 1) : count;
    const std::size_t before = memory();
    std::vector<std::unique_ptr<Follower>> followers;
    std::vector<semblante_head*> heads;
    for (std::size_t i = 0; i < faces; ++i) {
      followers.push_back(std::make_unique<Follower>(speech, kind.plays, 1000));
      if (kind.poses) heads.push_back(package.head(kind.vertices ? 0 : SEMBLANTE_HEAD_NO_VERTICES));
    }
    std::vector<float> positions;
    if (kind.vertices) positions.resize(std::size_t{semblante_head_vertex_count(heads[0])} * 3);
    const double begin = test::thread_cpu_ms();
    const double step = kind.plays ? display : batch;
    for (double since = 0; since < seconds * 1000; since += step) {
      for (std::size_t i = 0; i < faces; ++i) {
        followers[i]->receive_due(speech, since);
        if (!kind.plays || semblante_player_advance(followers[i]->player, 1000 + since, display) == 0) continue;
        if (kind.poses) semblante_player_show(followers[i]->player, heads[i]);
        if (kind.vertices) semblante_head_positions(heads[i], positions.data(), positions.size());
      }
    }
    const double ms = (test::thread_cpu_ms() - begin) / static_cast<double>(faces) / seconds;
    std::printf("| %s%s | %.1f | %.0f | %.1f |\n", kind.name, kind.vertices ? " (a twentieth as many)" : "", ms * 1000,
                1000 / ms, static_cast<double>(memory() - before) / 1000 / static_cast<double>(faces));
    for (semblante_head* head : heads) semblante_head_destroy(head);
  }
}

}  // namespace
}  // namespace semblante::bench

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::fprintf(stderr, "usage: bench_runtime FOLDER [FACES]\n");
    return 2;
  }
  try {
    const semblante::bench::Package package(argv[1]);
    // Two kinds of stream: an animation, and a camera, by which every FAP trembles.
    const semblante::bench::Speech talk(semblante::bench::made_up_talk(7, 30));
    const semblante::bench::Speech capture(semblante::bench::live_capture(7));
    semblante::bench::one_face(package, "talk", talk);
    semblante::bench::one_face(package, "live capture", capture);
    semblante::bench::many_faces(package, capture, argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1000);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_runtime: %s\n", error.what());
    return 1;
  }
  return 0;
}

// The C interface called wrongly: it says so by a value. With the sanitizers (tests/run --asan) nothing is read or
// written beside what the caller gave.
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "clients/runtime/semblante.h"
#include "tests/unit/runtime/owned.h"
#include "tests/unit/runtime/scripted_server.h"
#include "tests/unit/runtime/small_package.h"

namespace semblante::testing {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Misuse, NullHandles_AreRefusedOrDoNothing) {
  semblante_frame frame{};
  semblante_pose pose{};
  std::array<float, 52> floats{};
  std::uint32_t count = 7;
  std::size_t size = 7;
  EXPECT_EQ(semblante_head_triangles(nullptr, &count), nullptr);
  EXPECT_EQ(count, 0U);
  EXPECT_EQ(semblante_head_triangles(nullptr, nullptr), nullptr);
  EXPECT_EQ(semblante_head_uvs(nullptr), nullptr);
  EXPECT_EQ(semblante_head_face(nullptr), nullptr);
  EXPECT_EQ(semblante_head_pose(nullptr), nullptr);
  EXPECT_EQ(semblante_head_set_interpolated(nullptr, &frame, &frame, 0), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_head_get_pose(nullptr, &pose), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_head_set_pose(nullptr, &pose), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_head_positions(nullptr, floats.data(), 52), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_head_normals(nullptr, floats.data(), floats.data(), 52), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_sha256(nullptr, 1, nullptr), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_frame_from_arkit(nullptr, &frame, nullptr), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_arkit_from_frame(&frame, nullptr), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_frame_from_oculus(floats.data(), nullptr, nullptr), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_oculus_from_frame(nullptr, floats.data()), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_arkit_name(52), nullptr);
  EXPECT_EQ(semblante_oculus_name(15), nullptr);

  semblante_stream_start(nullptr, 0);
  semblante_stream_stop(nullptr, 0);
  semblante_stream_opened(nullptr, 0);
  semblante_stream_closed(nullptr, 0, 0);
  semblante_stream_tick(nullptr, 0);
  semblante_stream_measure_clock(nullptr, 0);
  semblante_stream_destroy(nullptr);
  EXPECT_EQ(semblante_stream_create(nullptr, nullptr, nullptr), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_stream_receive(nullptr, nullptr, 0, 0), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_stream_wake_time(nullptr), infinity);
  EXPECT_EQ(semblante_stream_take_bytes(nullptr, &size), nullptr);
  EXPECT_EQ(size, 0U);
  EXPECT_EQ(semblante_stream_next_event(nullptr, nullptr), 0U);
  EXPECT_EQ(semblante_stream_frames(nullptr, &count), nullptr);
  EXPECT_EQ(semblante_stream_get_state(nullptr), SEMBLANTE_STREAM_CLOSED);
  EXPECT_EQ(semblante_stream_header(nullptr, nullptr), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_stream_clock(nullptr, 0, nullptr), SEMBLANTE_INVALID_ARGUMENT);
  semblante_stream_resume_point(nullptr, nullptr, nullptr);
  EXPECT_EQ(semblante_stream_publish(nullptr, nullptr, 1, 0, 0), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_stream_publish_sound(nullptr, nullptr, 1, 0), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_stream_spoken(nullptr, 0, 0, 0, 0), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_stream_set_captions(nullptr, 1), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_score_words(nullptr, 1, nullptr, &count), SEMBLANTE_INVALID_ARGUMENT);

  semblante_player_destroy(nullptr);
  semblante_player_clear(nullptr);
  EXPECT_EQ(semblante_player_create(nullptr, nullptr, nullptr), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_player_follow(nullptr, nullptr), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_player_push(nullptr, nullptr, 1, 0), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_player_advance(nullptr, 0, 0), 0U);
  EXPECT_EQ(semblante_player_move_to(nullptr, 0), 0U);
  EXPECT_EQ(semblante_player_show(nullptr, nullptr), 0U);
  EXPECT_EQ(semblante_player_between(nullptr, nullptr, nullptr, nullptr), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_player_moment(nullptr, nullptr), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_TRUE(std::isnan(semblante_player_time(nullptr)));
  EXPECT_EQ(semblante_player_stats(nullptr, nullptr), SEMBLANTE_INVALID_ARGUMENT);

  semblante_performance_destroy(nullptr);
  EXPECT_EQ(semblante_performance_create(nullptr, 1, nullptr, nullptr), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_performance_name(nullptr), nullptr);
  EXPECT_EQ(semblante_performance_frame_at(nullptr, 0, 0, &frame), SEMBLANTE_INVALID_ARGUMENT);
  semblante_take_destroy(nullptr);
  EXPECT_EQ(semblante_take_read(0, nullptr, 1, nullptr, nullptr, nullptr), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_take_frames(nullptr, &count), nullptr);
  EXPECT_EQ(semblante_take_get_warning(nullptr, 0, nullptr), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_take_write(0, nullptr, 1, 0, nullptr, &size, nullptr), SEMBLANTE_INVALID_ARGUMENT);
  semblante_listener_destroy(nullptr);
  EXPECT_EQ(semblante_listener_push(nullptr, nullptr, 1, &count, nullptr), SEMBLANTE_INVALID_ARGUMENT);
  semblante_speaker_destroy(nullptr);
  semblante_speaker_reach(nullptr, 0, 0);
  semblante_speaker_end(nullptr, 0);
  EXPECT_EQ(semblante_speaker_say(nullptr, nullptr, 0, 0, 0), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_speaker_show(nullptr, 0, &frame), 0U);
  EXPECT_EQ(semblante_speaker_unpack(nullptr, 1, nullptr, 0), 0U);
}

/// A struct of a program that was compiled with a shorter or longer header: memory of exactly that size.
template <class Struct>
class Sized {
 public:
  explicit Sized(std::uint32_t size) : memory_(std::max<std::size_t>(size, sizeof(std::uint32_t))) {
    std::memcpy(memory_.data(), &size, sizeof(size));
  }
  Struct* get() { return reinterpret_cast<Struct*>(memory_.data()); }

 private:
  std::vector<char> memory_;
};

/// `call` with each size: refused for less than the member itself.
template <class Struct, class Call>
void expect_every_size(const Call& call) {
  for (std::uint32_t size = 0; size < sizeof(Struct) + 24; ++size) {
    Sized<Struct> given(size);
    EXPECT_EQ(call(given.get()), size >= sizeof(std::uint32_t)) << size;
  }
}

TEST(Misuse, StructsOfEverySize_AreReadAndWrittenWithinIt) {
  const SmallPackage small;
  const semblante_package package = small.view();
  expect_every_size<semblante_head_options>([&](const semblante_head_options* options) {
    semblante_head* head = nullptr;
    const bool made = semblante_head_create(&package, options, &head, nullptr) == SEMBLANTE_OK;
    semblante_head_destroy(head);
    return made;
  });
  expect_every_size<semblante_package>([&](const semblante_package* given) {
    semblante_head* head = nullptr;
    semblante_error error{};
    EXPECT_EQ(semblante_head_create(given, nullptr, &head, &error), SEMBLANTE_INVALID_ARGUMENT);
    return std::string(error.message) != "is null, or its size is not set";
  });
  expect_every_size<semblante_stream_options>([](const semblante_stream_options* options) {
    semblante_stream* stream = nullptr;
    const bool made = semblante_stream_create(options, &stream, nullptr) == SEMBLANTE_OK;
    semblante_stream_destroy(stream);
    return made;
  });
  expect_every_size<semblante_player_options>([](const semblante_player_options* options) {
    semblante_player* player = nullptr;
    const bool made = semblante_player_create(options, &player, nullptr) == SEMBLANTE_OK;
    semblante_player_destroy(player);
    return made;
  });
  semblante_player* made = nullptr;
  ASSERT_EQ(semblante_player_create(nullptr, &made, nullptr), SEMBLANTE_OK);
  const OwnedPlayer player(made);
  expect_every_size<semblante_player_statistics>([&](semblante_player_statistics* statistics) {
    return semblante_player_stats(player.get(), statistics) == SEMBLANTE_OK;
  });
  const semblante_timed_frame frame = jaw_at(0, 1);
  ASSERT_EQ(semblante_player_push(player.get(), &frame, 1, 0), SEMBLANTE_OK);
  ASSERT_EQ(semblante_player_advance(player.get(), 0, 0), 1U);
  expect_every_size<semblante_moment>(
      [&](semblante_moment* moment) { return semblante_player_moment(player.get(), moment) == SEMBLANTE_OK; });
  expect_every_size<semblante_event>([](semblante_event* event) {
    const ScriptedServer server;
    semblante_stream_start(server.stream, 0);
    return semblante_stream_next_event(server.stream, event) == 1;
  });
}

/// Numbers that no clock and no face has, among some that are usual.
class Hostile {
 public:
  explicit Hostile(unsigned seed) : random_(seed) {}
  double time() {
    constexpr double times[] = {0, -1, 5, 1e3, 9e15, -9e15, 9.1e15, 1e308, -1e308, nan, infinity, -infinity, 1e-320};
    return upto(3) == 0 ? times[upto(std::size(times))] : static_cast<double>(upto(100'000));
  }
  float value() {
    constexpr float values[] = {0, -0.0F, 1e-40F, 300, -1e5F, 1e9F, 3.4e38F, -3.4e38F, static_cast<float>(nan)};
    return values[upto(std::size(values))];
  }
  semblante_timed_frame frame() {
    semblante_timed_frame made{};
    made.time = time();
    auto* const high = reinterpret_cast<std::uint8_t*>(&made.frame);
    for (std::size_t i = 0; i < 8; ++i) high[i] = static_cast<std::uint8_t>(upto(256));
    for (float& fap : made.frame.fap) fap = upto(20) == 0 ? value() : 10;
    return made;
  }
  std::vector<std::uint8_t> bytes() {
    std::vector<std::uint8_t> made(upto(40));
    for (std::uint8_t& byte : made) byte = static_cast<std::uint8_t>(upto(256));
    if (!made.empty()) made[0] = static_cast<std::uint8_t>(upto(16));
    return made;
  }
  std::size_t upto(std::size_t end) { return std::uniform_int_distribution<std::size_t>(0, end - 1)(random_); }

 private:
  std::mt19937 random_;
};

/// One stream, one player and one head, called in any order with anything.
class Anyhow {
 public:
  explicit Anyhow(unsigned seed) : hostile_(seed) {
    semblante_stream_options options{};
    options.size = sizeof(options);
    options.role = seed % 2;
    options.sound = options.text = options.captions = 1;
    options.batch = seed % 3;
    EXPECT_EQ(semblante_stream_create(&options, &stream_, nullptr), SEMBLANTE_OK);
    semblante_player* player = nullptr;
    semblante_player_options playing{};
    playing.size = sizeof(playing);
    playing.eased = seed % 2;
    playing.max_frames = seed % 5 == 0 ? std::numeric_limits<std::uint32_t>::max() : 0;
    EXPECT_EQ(semblante_player_create(&playing, &player, nullptr), SEMBLANTE_OK);
    player_.reset(player);
    const semblante_package package = small_.view();
    semblante_head* head = nullptr;
    EXPECT_EQ(semblante_head_create(&package, nullptr, &head, nullptr), SEMBLANTE_OK);
    head_.reset(head);
  }
  ~Anyhow() { semblante_stream_destroy(stream_); }
  Anyhow(const Anyhow&) = delete;
  Anyhow& operator=(const Anyhow&) = delete;

  void call() {
    switch (hostile_.upto(16)) {
      case 0:
        return semblante_stream_start(stream_, hostile_.time());
      case 1:
        return semblante_stream_opened(stream_, hostile_.time());
      case 2:
        return semblante_stream_closed(stream_, 7, hostile_.time());
      case 3:
        return semblante_stream_tick(stream_, hostile_.time());
      case 4:
        return semblante_stream_stop(stream_, hostile_.upto(8) == 0 ? hostile_.time() : nan);
      case 5:
      case 6: {
        const auto bytes = hostile_.bytes();
        return void(semblante_stream_receive(stream_, bytes.data(), bytes.size(), hostile_.time()));
      }
      case 7: {
        const semblante_timed_frame frames[] = {hostile_.frame(), hostile_.frame()};
        return void(semblante_stream_publish(stream_, frames, 2, hostile_.time(), hostile_.time()));
      }
      case 8: {
        const auto bytes = hostile_.bytes();
        return void(semblante_stream_publish_sound(stream_, bytes.data(), static_cast<std::uint32_t>(bytes.size()),
                                                   hostile_.time()));
      }
      case 9:
        return void(semblante_player_follow(player_.get(), hostile_.upto(2) == 0 ? stream_ : nullptr));
      case 10: {
        const semblante_timed_frame frame = hostile_.frame();
        return void(semblante_player_push(player_.get(), &frame, 1, hostile_.time()));
      }
      case 11:
        semblante_player_advance(player_.get(), hostile_.time(), hostile_.time());
        return void(semblante_player_show(player_.get(), head_.get()));
      case 12:
        semblante_player_move_to(player_.get(), hostile_.time());
        return void(semblante_player_show(player_.get(), head_.get()));
      case 13: {
        const semblante_timed_frame from = hostile_.frame();
        const semblante_timed_frame to = hostile_.frame();
        return void(semblante_head_set_interpolated(head_.get(), &from.frame, &to.frame, hostile_.value()));
      }
      case 14: {
        const semblante_timed_frame frame = hostile_.frame();
        return void(semblante_head_set_frame(head_.get(), &frame.frame));
      }
      default:
        return look();
    }
  }

 private:
  void look() {
    semblante_event event{};
    event.size = sizeof(event);
    while (semblante_stream_next_event(stream_, &event) != 0) {
      EXPECT_LE(event.type, SEMBLANTE_EVENT_TEXT);
    }
    std::size_t size = 0;
    while (semblante_stream_take_bytes(stream_, &size) != nullptr) {
      EXPECT_GT(size, 0U);
    }
    std::array<float, 12> positions{};
    EXPECT_EQ(semblante_head_positions(head_.get(), positions.data(), positions.size()), SEMBLANTE_OK);
    EXPECT_FALSE(std::isnan(semblante_stream_wake_time(stream_)));
  }

  Hostile hostile_;
  SmallPackage small_;
  semblante_stream* stream_ = nullptr;
  OwnedPlayer player_;
  OwnedHead head_;
};

TEST(Misuse, AnyCallsInAnyOrder_EndWell) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    Anyhow caller(seed);
    for (int i = 0; i < 400; ++i) caller.call();
  }
}

}  // namespace
}  // namespace semblante::testing

#include <array>
#include <random>

#include "tests/unit/runtime/allocation_counter.h"
#include "tests/unit/runtime/owned.h"
#include "tests/unit/runtime/scripted_server.h"
#include "tests/unit/runtime/small_package.h"

namespace semblante::testing {
namespace {

/// Ten seconds of a stream of 25 frames a second in batches of three, shown 60 times a second.
TEST(Allocation, AFrame_AllocatesNothingAfterTheBeginning) {
  for (const bool eased : {false, true}) {
    const SmallPackage small;
    const semblante_package package = small.view();
    semblante_head* head = nullptr;
    ASSERT_EQ(semblante_head_create(&package, nullptr, &head, nullptr), SEMBLANTE_OK);
    semblante_player_options options{};
    options.size = sizeof(options);
    options.eased = eased ? 1 : 0;
    semblante_player* player = nullptr;
    ASSERT_EQ(semblante_player_create(&options, &player, nullptr), SEMBLANTE_OK);
    ScriptedServer server;
    ASSERT_EQ(semblante_player_follow(player, server.stream), SEMBLANTE_OK);
    server.begin(1000, 5000);

    // The server's side allocates, so its messages are made before.
    std::mt19937 random(1);
    PackedEncoder encoder({10, 5000, face(0)});
    std::vector<std::vector<std::uint8_t>> messages;
    for (std::uint64_t i = 0; i < 200; ++i) {
      Frames frames{0, 5040 + 120 * i, {}};
      for (std::uint32_t k = 0; k < 3; ++k) {
        FaceFrame state = face(static_cast<int>(random() % 100));
        state.viseme = {static_cast<std::uint8_t>(random() % 15), 0, 63};
        frames.frames.push_back({40 * k, state});
      }
      messages.push_back(encoder.encode(frames));
    }
    std::array<float, 12> positions{};
    semblante_event event{};
    event.size = sizeof(event);
    std::size_t next = 0;
    std::size_t shown = 0;
    std::size_t before = 0;
    for (double now = 1000; next < messages.size(); now += 1000.0 / 60) {
      if (next == 50) before = allocation_count();
      if (now >= 1160 + 120 * static_cast<double>(next)) {
        semblante_stream_receive(server.stream, messages[next].data(), messages[next].size(), now);
        ++next;
        while (semblante_stream_next_event(server.stream, &event) != 0) ASSERT_EQ(event.type, SEMBLANTE_EVENT_FRAMES);
        std::uint32_t count = 0;
        ASSERT_NE(semblante_stream_frames(server.stream, &count), nullptr);
      }
      semblante_stream_tick(server.stream, now);
      std::size_t size = 0;
      while (semblante_stream_take_bytes(server.stream, &size) != nullptr) {
      }
      if (semblante_player_advance(player, now, 1000.0 / 60) != 0) shown += semblante_player_show(player, head);
      semblante_head_positions(head, positions.data(), positions.size());
    }
    EXPECT_EQ(allocation_count() - before, 0U) << (eased ? "eased" : "linear");
    EXPECT_GT(shown, 1000U);
    semblante_player_destroy(player);
    semblante_head_destroy(head);
  }
}

/// What one of many players costs before and while it plays.
TEST(Allocation, APlayer_IsSmall) {
  ScriptedServer server;
  server.begin(1000, 5000);
  semblante_player* player = nullptr;
  const std::size_t before = allocation_count();
  ASSERT_EQ(semblante_player_create(nullptr, &player, nullptr), SEMBLANTE_OK);
  ASSERT_EQ(semblante_player_follow(player, server.stream), SEMBLANTE_OK);
  EXPECT_LE(allocation_count() - before, 4U);
  semblante_player_destroy(player);
}

}  // namespace
}  // namespace semblante::testing

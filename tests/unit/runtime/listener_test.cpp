// Listeners at the border: what is refused, and structs of an older caller.
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "clients/runtime/semblante.h"

namespace {

semblante_listener* made(uint32_t rate) {
  const semblante_listener_options options = {sizeof(options), rate};
  semblante_listener* listener = nullptr;
  EXPECT_EQ(semblante_listener_create(&options, &listener, nullptr), SEMBLANTE_OK);
  return listener;
}

TEST(Listener, RefusesRatesAndNulls) {
  semblante_listener* listener = nullptr;
  semblante_error error{};
  for (const uint32_t rate : {0U, 7'999U, 192'001U, 0xFFFFFFFFU}) {
    const semblante_listener_options options = {sizeof(options), rate};
    EXPECT_EQ(semblante_listener_create(&options, &listener, &error), SEMBLANTE_INVALID_ARGUMENT);
    EXPECT_STREQ(error.where, "options.sample_rate");
    EXPECT_EQ(listener, nullptr);
  }
  EXPECT_EQ(semblante_listener_create(nullptr, &listener, &error), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_listener_create(nullptr, nullptr, &error), SEMBLANTE_INVALID_ARGUMENT);
  semblante_listener_destroy(nullptr);

  listener = made(16'000);
  const float sample = 0.0F;
  uint32_t taken = 7;
  semblante_heard heard = {};
  heard.size = sizeof(heard);
  EXPECT_EQ(semblante_listener_push(nullptr, &sample, 1, &taken, &heard), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(taken, 0U);
  EXPECT_EQ(semblante_listener_push(listener, nullptr, 1, &taken, &heard), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_listener_push(listener, &sample, 1, nullptr, &heard), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_listener_push(listener, &sample, 1, &taken, nullptr), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_listener_push(listener, nullptr, 0, &taken, &heard), SEMBLANTE_UNAVAILABLE);
  semblante_listener_destroy(listener);
}

TEST(Listener, WritesNoMoreThanTheCallersStructHolds) {
  semblante_listener* const listener = made(8'000);
  const std::vector<float> silence(8'000);
  semblante_heard heard = {};
  heard.size = offsetof(semblante_heard, probability);
  heard.probability[0] = 7.0F;
  uint32_t taken = 0;
  ASSERT_EQ(semblante_listener_push(listener, silence.data(), 8'000, &taken, &heard), SEMBLANTE_OK);
  EXPECT_EQ(heard.time, 5.0);
  EXPECT_EQ(heard.probability[0], 7.0F);
  EXPECT_GT(heard.weights[0], 0.9F);
  EXPECT_EQ(taken, static_cast<uint32_t>(8 * (5.0 + SEMBLANTE_LISTENER_DELAY_MS)));
  semblante_listener_destroy(listener);
}

}  // namespace

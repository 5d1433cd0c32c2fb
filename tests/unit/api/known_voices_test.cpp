#include "server/api/known_voices.h"

#include <gtest/gtest.h>

namespace semblante::api {
namespace {

TEST(KnownVoices, AreKept_UntilTheyAreTooOld) {
  KnownVoices voices;
  const auto told = KnownVoices::Clock::now();
  EXPECT_FALSE(voices.at(told)) << "nobody asked the program yet";
  voices.keep({{.voice = "beeps", .label = "Tones", .language = "en"}}, told);
  const auto kept = voices.at(told + KnownVoices::max_age);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->at(0).voice, "beeps");
  EXPECT_FALSE(voices.at(told + KnownVoices::max_age + std::chrono::milliseconds(1)));
}

}  // namespace
}  // namespace semblante::api

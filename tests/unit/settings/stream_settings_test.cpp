#include "server/settings/stream_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "server/settings/text.h"

namespace semblante::settings {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::HasSubstr;

TEST(StreamSettings, WhatIsAbsent_HasItsDefault) {
  const auto settings = read_stream_settings(Json::object(), "talk");
  ASSERT_TRUE(settings);
  StreamSettings expected;
  expected.title = "talk";
  EXPECT_EQ(*settings, expected);
  EXPECT_EQ(expected.batch_interval, 100U);
}

TEST(StreamSettings, EverySettingIsRead) {
  const Json json = {{"id", "talk"},         {"title", "Talk"},          {"model", "head"},  {"viseme_share", 0.25},
                     {"batch_interval", 40}, {"quantizer_scale", 0.125}, {"is_public", true}};
  const auto settings = read_stream_settings(json, "other");
  ASSERT_TRUE(settings) << settings.error().message;
  const StreamSettings defaults;
  std::size_t visited = 0;
  for_each_setting(*settings, [&](std::string_view name, const auto& value) {
    EXPECT_TRUE(json.contains(name)) << name << ": give it a value here that is not its default";
    for_each_setting(defaults, [&](std::string_view other, const auto& default_value) {
      if constexpr (std::is_same_v<decltype(value), decltype(default_value)>) {
        if (name == other) {
          EXPECT_NE(value, default_value) << name << " was not read";
        }
      }
    });
    ++visited;
  });
  EXPECT_EQ(json.size(), visited + 1);
}

TEST(StreamSettings, Null_IsNoModelAndNoVisemeShare) {
  const auto settings = read_stream_settings({{"model", nullptr}, {"viseme_share", nullptr}}, "talk");
  ASSERT_TRUE(settings) << settings.error().message;
  EXPECT_EQ(settings->model, "");
  EXPECT_EQ(settings->viseme_share, std::nullopt);
}

/// Languages and emoji are written with characters that have no picture of their own.
TEST(StreamSettings, TitlesWithJoiners_AreTaken) {
  for (const char* title : {"\u0645\u06CC\u200C\u062E\u0648\u0627\u0647\u0645", "\U0001F469\u200D\U0001F467"}) {
    const auto settings = read_stream_settings({{"title", title}}, "talk");
    ASSERT_TRUE(settings) << title;
    EXPECT_EQ(settings->title, title);
  }
}

TEST(StreamSettings, WhatIsWrong_IsNamed) {
  const auto expect_wrong = [](const char* name, const Json& value, const char* message) {
    const auto settings = read_stream_settings({{name, value}}, "talk");
    ASSERT_FALSE(settings) << name << " " << value;
    EXPECT_EQ(settings.error().where, std::string("/") + name);
    EXPECT_THAT(settings.error().message, HasSubstr(message)) << value;
  };
  for (const char* name : {"title", "model"}) {
    expect_wrong(name, 5, "must be a string");
    for (const char* text : {"", " ", "\u200B", "\u200D \u2060", "\uFEFF"})
      expect_wrong(name, text, "must not be empty");
    for (const char* text : {"a\nb", "a\u0085b", "a\u2028b", "a\u202Eb", "a\u2066b"})
      expect_wrong(name, text, "control character");
    expect_wrong(name, std::string(201, 'a'), "more than");
  }
  expect_wrong("title", nullptr, "must be a string");
  for (const Json& value : {Json(-0.01), Json(1.01), Json("0.5"), Json(true)})
    expect_wrong("viseme_share", value, "from 0 to 1");
  for (const Json& value : {Json(-1), Json(1001), Json(0.5), Json(nullptr), Json("5"), Json(1e300)})
    expect_wrong("batch_interval", value, "from 0 to 1000");
  for (const Json& value : {Json(0), Json(2), Json(0.3), Json(nullptr), Json("1")})
    expect_wrong("quantizer_scale", value, "0.125");
  const auto two = read_stream_settings({{"batch_interval", -1}, {"title", 7}}, "talk");
  ASSERT_FALSE(two);
  EXPECT_EQ(two.error().where, "/title") << "the first in the order of the settings";
}

TEST(StreamSettings, Bounds_AreTaken) {
  for (const int interval : {0, 1000})
    EXPECT_EQ(read_stream_settings({{"batch_interval", interval}}, "t")->batch_interval, interval);
  for (const double share : {0.0, 1.0})
    EXPECT_EQ(read_stream_settings({{"viseme_share", share}}, "t")->viseme_share, share);
  EXPECT_EQ(read_stream_settings({{"title", std::string(200, 'a')}}, "t")->title.size(), 200U);
  EXPECT_EQ(read_stream_settings({{"model", std::string(64, 'a')}}, "t")->model.size(), 64U);
}

TEST(Text, HasABoundAndNoControlCharacters) {
  EXPECT_TRUE(check_text("Zo\xc3\xab", 4));
  EXPECT_FALSE(check_text("Zo\xc3\xab", 3));
  EXPECT_FALSE(check_text("", 3));
  EXPECT_FALSE(check_text("\x7f", 3));
}

}  // namespace
}  // namespace semblante::settings

// Performances and takes, against protocol/vectors.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "clients/runtime/semblante.h"
#include "tests/unit/runtime/owned.h"

namespace semblante::testing {
namespace {

using nlohmann::json;

std::string read(const std::string& path) {
  std::ifstream file(SEMBLANTE_SOURCE_DIR "/protocol/" + path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

OwnedPerformance make(const std::string& text, semblante_error* error = nullptr) {
  semblante_performance* performance = nullptr;
  const auto result = semblante_performance_create(text.data(), text.size(), &performance, error);
  EXPECT_EQ(result == SEMBLANTE_OK, performance != nullptr);
  return OwnedPerformance(performance);
}

OwnedTake take_of(semblante_take_format format, const std::string& text, semblante_error* error = nullptr,
                  const semblante_take_options* options = nullptr) {
  semblante_take* take = nullptr;
  const auto result = semblante_take_read(format, text.data(), text.size(), options, &take, error);
  EXPECT_EQ(result == SEMBLANTE_OK, take != nullptr);
  return OwnedTake(take);
}

TEST(RuntimePerformance, GoldenFrames_AreThose) {
  for (const auto& [document, frames] :
       {std::pair("vectors/performance/corners.json", "vectors/performance/corners.frames.json"),
        std::pair("examples/performances/hello.json", "vectors/performance/hello.frames.json")}) {
    const OwnedPerformance performance = make(read(document));
    ASSERT_TRUE(performance) << document;
    const json expected = json::parse(read(frames));
    ASSERT_GT(expected["frames"].size(), 10U);
    for (const json& at : expected["frames"]) {
      semblante_frame frame{};
      const double time = at["time"].get<double>();
      ASSERT_EQ(semblante_performance_frame_at(performance.get(), time, time, &frame), SEMBLANTE_OK);
      for (std::size_t fap = 3; fap <= SEMBLANTE_FAP_COUNT; ++fap) {
        const json faps = at.value("faps", json::object());
        EXPECT_NEAR(frame.fap[fap], faps.value(std::to_string(fap), 0.0), 0.01) << time << " ms, FAP " << fap;
      }
      const json viseme = at.value("viseme", json::object());
      EXPECT_EQ(frame.viseme1, viseme.value("select1", 0)) << time;
      EXPECT_EQ(frame.viseme_blend, viseme.value("blend", 0)) << time;
      const json expression = at.value("expression", json::object());
      EXPECT_EQ(frame.expression1, expression.value("select1", 0)) << time;
      EXPECT_EQ(frame.intensity1, expression.value("intensity1", 0)) << time;
    }
  }
}

TEST(RuntimePerformance, Documents_AreAcceptedOrRefusedWithThePointer) {
  const json documents = json::parse(read("vectors/performance/documents.json"));
  for (const json& good : documents["good"]) {
    // One without anything to play can be read and written by programs that edit it; it is only not to be played.
    const bool is_playable = !good.value("cues", json::array()).empty() || good.contains("idle");
    EXPECT_EQ(make(good.dump()) != nullptr, is_playable) << good;
  }
  ASSERT_GT(documents["refused"].size(), 20U);
  for (const json& bad : documents["refused"]) {
    semblante_error error{};
    EXPECT_FALSE(make(bad["document"].dump(), &error)) << bad;
    if (bad["where"] != "") {
      EXPECT_EQ(std::string(error.where), bad["where"].get<std::string>()) << bad;
    }
  }
  semblante_performance* performance = nullptr;
  EXPECT_EQ(semblante_performance_create(nullptr, 0, &performance, nullptr), SEMBLANTE_INVALID_ARGUMENT);
}

TEST(RuntimePerformance, NameDurationAndTimes) {
  const OwnedPerformance performance = make(read("examples/performances/hello.json"));
  EXPECT_STRNE(semblante_performance_name(performance.get()), "");
  EXPECT_GT(semblante_performance_duration(performance.get()), 0);
  semblante_frame frame{};
  for (const double bad : {-1.0, std::nan(""), HUGE_VAL, 1e16}) {
    EXPECT_EQ(semblante_performance_frame_at(performance.get(), bad, 0, &frame), SEMBLANTE_INVALID_ARGUMENT);
    EXPECT_EQ(semblante_performance_frame_at(performance.get(), 0, bad, &frame), SEMBLANTE_INVALID_ARGUMENT);
  }
}

TEST(RuntimePerformance, WordsThatDoNotFit_EndWithACharacter) {
  for (const std::string first : {"", "a"}) {
    std::string member = first;
    std::string told = "/" + first;
    for (int i = 0; i < 90; ++i) member += "\u00e9";
    while (told.size() + 2 < sizeof(semblante_error::where)) told += "\u00e9";
    semblante_error error{};
    const std::string document =
        R"({"format":"semblante.performance","version":1,"name":"a","cues":[],")" + member + "\":1}";
    EXPECT_EQ(make(document, &error), nullptr);
    EXPECT_EQ(error.where, told);
  }
}

TEST(Take, FapVectors_AreReadWithTheirWarnings) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SEMBLANTE_SOURCE_DIR "/protocol/vectors/fap")) {
    if (entry.path().extension() != ".fap") continue;
    ++files;
    const std::string name = entry.path().stem().string();
    SCOPED_TRACE(name);
    const OwnedTake take = take_of(SEMBLANTE_TAKE_FAP, read("vectors/fap/" + name + ".fap"));
    ASSERT_TRUE(take);
    const json expected = json::parse(read("vectors/fap/" + name + ".json"));
    EXPECT_EQ(semblante_take_frame_rate(take.get()), expected["file"]["rate"].get<double>());
    ASSERT_EQ(semblante_take_warning_count(take.get()), expected["warnings"].size());
    for (std::uint32_t i = 0; i < expected["warnings"].size(); ++i) {
      semblante_take_warning warning{};
      warning.size = sizeof(warning);
      ASSERT_EQ(semblante_take_get_warning(take.get(), i, &warning), SEMBLANTE_OK);
      EXPECT_EQ(warning.line, expected["warnings"][i]["line"].get<std::uint32_t>());
      EXPECT_EQ(warning.count, expected["warnings"][i]["count"].get<std::uint32_t>());
      EXPECT_NE(warning.message[0], '\0');
    }
    // The values of the first and of the last frame of the file, at their times.
    std::uint32_t count = 0;
    const semblante_timed_frame* frames = semblante_take_frames(take.get(), &count);
    ASSERT_GE(count, expected["file"]["frames"].size());
    for (const json* frame : {&expected["file"]["frames"].front(), &expected["file"]["frames"].back()}) {
      const semblante_timed_frame& read_as =
          frame == &expected["file"]["frames"].front() ? frames[0] : frames[count - 1];
      const double time = 1000 * (*frame)["number"].get<double>() / expected["file"]["rate"].get<double>();
      EXPECT_NEAR(read_as.time, time, 0.5);
      const json values = frame->value("values", json::object());
      for (const auto& [fap, value] : values.items()) {
        EXPECT_FLOAT_EQ(read_as.frame.fap[std::stoul(fap)], value.get<float>());
      }
    }
  }
  EXPECT_GE(files, 20U);
}

TEST(Take, Refused_NamesThePlace) {
  const json refused = json::parse(read("vectors/fap/refused.json"));
  std::size_t count = 0;
  for (const json& bad : refused["refused"]) {
    if (!bad.contains("text")) continue;
    semblante_error error{};
    EXPECT_FALSE(take_of(SEMBLANTE_TAKE_FAP, bad["text"].get<std::string>(), &error)) << bad;
    EXPECT_EQ(std::string(error.where), bad["where"].get<std::string>()) << bad;
    ++count;
  }
  EXPECT_GT(count, 5U);
  semblante_error error{};
  EXPECT_FALSE(take_of(SEMBLANTE_TAKE_LIVE_LINK_CSV, "Timecode,BlendShapeCount\n", &error));
  semblante_take* take = nullptr;
  EXPECT_EQ(semblante_take_read(7, "", 0, nullptr, &take, &error), SEMBLANTE_INVALID_ARGUMENT);
}

TEST(Take, WhatAFrameOmits_IsZeroOrStays) {
  const auto mask = [](std::initializer_list<std::size_t> faps) {
    std::string text;
    for (std::size_t fap = 1; fap <= SEMBLANTE_FAP_COUNT; ++fap)
      text += std::find(faps.begin(), faps.end(), fap) == faps.end() ? "0 " : "1 ";
    return text + "\n";
  };
  const std::string text = "2.1 x 10 2\n" + mask({3}) + "0 400\n" + mask({14}) + "5 7\n";
  const auto jaws = [&](std::uint32_t absent, std::uint32_t gaps) {
    semblante_take_options options{sizeof(options), absent, gaps};
    const OwnedTake take = take_of(SEMBLANTE_TAKE_FAP, text, nullptr, &options);
    std::uint32_t count = 0;
    const semblante_timed_frame* frames = semblante_take_frames(take.get(), &count);
    std::vector<std::pair<double, float>> found;
    for (std::uint32_t i = 0; i < count; ++i) found.emplace_back(frames[i].time, frames[i].frame.fap[3]);
    return found;
  };
  using Jaws = std::vector<std::pair<double, float>>;
  EXPECT_EQ(jaws(0, 0), (Jaws{{0, 400}, {400, 400}, {500, 0}}));
  EXPECT_EQ(jaws(1, 1), (Jaws{{0, 400}, {500, 400}}));

  semblante_error error{};
  semblante_take_options options{sizeof(options), 2, 0};
  EXPECT_FALSE(take_of(SEMBLANTE_TAKE_FAP, text, &error, &options));
  EXPECT_STREQ(error.where, "options.absent");
  options = {0, 0, 0};
  EXPECT_FALSE(take_of(SEMBLANTE_TAKE_FAP, text, &error, &options));
  EXPECT_STREQ(error.where, "options.size");
}

std::string written(std::uint32_t format, const semblante_timed_frame* frames, std::uint32_t count, double rate = 0) {
  std::size_t size = 0;
  EXPECT_EQ(semblante_take_write(format, frames, count, rate, nullptr, &size, nullptr), SEMBLANTE_BUFFER_TOO_SMALL);
  std::string text(size, '\0');
  EXPECT_EQ(semblante_take_write(format, frames, count, rate, text.data(), &size, nullptr), SEMBLANTE_OK);
  EXPECT_EQ(size, text.size());
  size = text.size() - 1;
  EXPECT_EQ(semblante_take_write(format, frames, count, rate, text.data(), &size, nullptr), SEMBLANTE_BUFFER_TOO_SMALL);
  return text;
}

TEST(Take, WrittenAndReadAgain_IsTheSameMotion) {
  std::vector<semblante_timed_frame> frames(20);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].time = 40.0 * static_cast<double>(i) + 1000;
    frames[i].frame.fap[3] = static_cast<float>(20 * i);
    frames[i].frame.fap[49] = static_cast<float>(1000 * i);
    frames[i].frame.viseme1 = 3;
    frames[i].frame.viseme_blend = 40;
  }
  const auto count = static_cast<std::uint32_t>(frames.size());
  const OwnedTake fap = take_of(SEMBLANTE_TAKE_FAP, written(SEMBLANTE_TAKE_FAP, frames.data(), count));
  ASSERT_TRUE(fap);
  std::uint32_t read_count = 0;
  const semblante_timed_frame* read_frames = semblante_take_frames(fap.get(), &read_count);
  ASSERT_EQ(read_count, count);
  EXPECT_EQ(semblante_take_frame_rate(fap.get()), 25);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(read_frames[i].time, frames[i].time - 1000) << "from the start";
    EXPECT_EQ(read_frames[i].frame.fap[3], frames[i].frame.fap[3]);
    EXPECT_EQ(read_frames[i].frame.viseme_blend, 40);
  }

  const OwnedTake csv =
      take_of(SEMBLANTE_TAKE_LIVE_LINK_CSV, written(SEMBLANTE_TAKE_LIVE_LINK_CSV, frames.data(), count));
  ASSERT_TRUE(csv);
  read_frames = semblante_take_frames(csv.get(), &read_count);
  ASSERT_EQ(read_count, count);
  EXPECT_NEAR(semblante_take_frame_rate(csv.get()), 25, 0.2);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_NEAR(read_frames[i].time, frames[i].time - 1000, 1);
    EXPECT_NEAR(read_frames[i].frame.fap[49], frames[i].frame.fap[49], 2) << "the turn of the head passes unchanged";
  }
}

TEST(Take, WhatCannotBeWritten_IsRefused) {
  semblante_timed_frame frames[2] = {};
  std::size_t size = 0;
  semblante_error error{};
  const auto result = [&](std::uint32_t count, double rate = 0) {
    return semblante_take_write(SEMBLANTE_TAKE_FAP, frames, count, rate, nullptr, &size, &error);
  };
  EXPECT_EQ(result(0), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(result(2, std::nan("")), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(result(2, 2000), SEMBLANTE_INVALID_ARGUMENT);
  frames[0].time = 5;
  EXPECT_EQ(result(2), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_STREQ(error.message, "the times must be numbers that do not fall");
  frames[1].time = 1e12;
  EXPECT_EQ(result(2), SEMBLANTE_INVALID_ARGUMENT);
  frames[1].time = 6;
  frames[1].frame.fap[7] = HUGE_VALF;
  EXPECT_EQ(result(2), SEMBLANTE_INVALID_ARGUMENT);
}

}  // namespace
}  // namespace semblante::testing

#include "protocol/cpp/fap_file.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "protocol/cpp/fap_number.h"

namespace semblante {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

fs::path vectors() { return fs::path(SEMBLANTE_SOURCE_DIR) / "protocol/vectors/fap"; }

/// A file in the words of the golden files.
json to_json(const FapFile& file) {
  json frames = json::array();
  for (const auto& frame : file.frames) {
    json item = {{"number", frame.number}, {"present", json::array()}, {"values", json::object()}};
    for (std::size_t fap = 1; fap <= 68; ++fap) {
      if (!frame.present[fap]) continue;
      item["present"].push_back(fap);
      if (fap >= 3) item["values"][std::to_string(fap)] = frame.value[fap];
    }
    const auto& v = frame.viseme;
    if (frame.present[1]) item["viseme"] = {v.select1, v.select2, v.blend, v.viseme_def};
    const auto& e = frame.expression;
    if (frame.present[2]) {
      item["expression"] = {e.select1, e.intensity1, e.select2, e.intensity2, e.init_face, e.expression_def};
    }
    frames.push_back(std::move(item));
  }
  return {{"rate", file.rate}, {"name", file.name}, {"frames", std::move(frames)}};
}

TEST(FapFile, GoldenFiles_EveryQuirk_AreReadAsTheySay) {
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(vectors())) {
    if (entry.path().extension() != ".fap") continue;
    ++files;
    const json expected = json::parse(read(fs::path(entry.path()).replace_extension(".json")));
    const auto reading = read_fap_file(read(entry.path()));
    ASSERT_TRUE(reading) << entry.path() << ": " << reading.error().where << ": " << reading.error().message;
    EXPECT_EQ(to_json(reading->file), expected.at("file")) << entry.path();
    json warnings = json::array();
    for (const auto& [oddity, line, count] : reading->warnings) {
      warnings.push_back({{"oddity", to_string(oddity)}, {"line", line}, {"count", count}});
    }
    EXPECT_EQ(warnings, expected.at("warnings")) << entry.path();
  }
  EXPECT_GE(files, 20U);
}

TEST(FapFile, GoldenFiles_WrittenAndReadAgain_AreExact) {
  for (const auto& entry : fs::directory_iterator(vectors())) {
    if (entry.path().extension() != ".fap") continue;
    const json expected = json::parse(read(fs::path(entry.path()).replace_extension(".json")));
    const auto first = read_fap_file(read(entry.path()));
    ASSERT_TRUE(first);
    const std::string written = write_fap_file(first->file);
    EXPECT_EQ(written, expected.at("written").get<std::string>()) << entry.path();
    const auto second = read_fap_file(written);
    ASSERT_TRUE(second) << entry.path();
    EXPECT_EQ(second->file, first->file) << entry.path();
    EXPECT_EQ(write_fap_file(second->file), written) << entry.path();
    for (const auto& warning : second->warnings) EXPECT_EQ(warning.oddity, FapFileOddity::numbers_left_out);
  }
}

TEST(FapFile, GoldenFiles_OfNoFapFile_AreRefusedByLineAndWord) {
  const json file = json::parse(read(vectors() / "refused.json"));
  for (const json& refused : file.at("refused")) {
    const std::string name = refused.at("name");
    const auto reading = read_fap_file(refused.at("text").get<std::string>());
    ASSERT_FALSE(reading) << name;
    const std::map<ErrorCode, std::string> names = {{ErrorCode::malformed, "malformed"},
                                                    {ErrorCode::empty, "empty"},
                                                    {ErrorCode::truncated, "truncated"},
                                                    {ErrorCode::out_of_range, "out_of_range"},
                                                    {ErrorCode::too_large, "too_large"}};
    EXPECT_EQ(names.at(reading.error().code), refused.at("code").get<std::string>()) << name;
    EXPECT_EQ(reading.error().where, refused.at("where").get<std::string>()) << name;
    EXPECT_FALSE(reading.error().message.empty());
  }
}

TEST(FapFile, Limits_AreKept) {
  const std::string one = read(vectors() / "plain.fap");
  FapFileLimits limits;
  limits.bytes = one.size() - 1;
  EXPECT_EQ(read_fap_file(one, limits).error().code, ErrorCode::too_large);
  limits = {};
  limits.frames = 2;
  const auto reading = read_fap_file(one, limits);
  ASSERT_FALSE(reading);
  EXPECT_EQ(reading.error().code, ErrorCode::too_large);
  EXPECT_EQ(reading.error().where, "line 9");
  limits.frames = 3;
  EXPECT_TRUE(read_fap_file(one, limits));
}

TEST(FapFile, EveryPrefixOfAFile_IsReadOrRefused) {
  const std::string text = read(vectors() / "all_faps.fap");
  for (std::size_t size = 0; size < text.size(); ++size) {
    const auto reading = read_fap_file(text.substr(0, size));
    if (reading) {
      EXPECT_LE(reading->file.frames.size(), 2U);
    } else {
      EXPECT_TRUE(reading.error().where.starts_with("line ")) << size;
    }
  }
}

TEST(FapFile, WordsOfTheFileInMessages_ArePrintableAndShort) {
  const auto reading = read_fap_file("2.1 x 25 1\n" + std::string(40, '\x01') + "\xff\n");
  ASSERT_FALSE(reading);
  EXPECT_NE(reading.error().message.find("\"????????????????????????...\""), std::string::npos);
}

TEST(FapFile, RandomFiles_WrittenAndRead_AreTheSameDocument) {
  std::mt19937 random(20);
  for (int round = 0; round < 50; ++round) {
    FapFile file;
    file.rate = 1.0 + static_cast<double>(random() % 100'000) / 1000.0;
    file.name.append("r").append(std::to_string(round));
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < 1 + random() % 20; ++i, number += 1 + random() % 3) {
      FapFileFrame frame;
      frame.number = number;
      for (std::size_t fap = 3; fap <= 68; ++fap) {
        if (random() % 3 != 0) continue;
        frame.present.set(fap);
        const double real = std::ldexp(static_cast<double>(random()), static_cast<int>(random() % 30) - 32) - 1.0;
        frame.value[fap] = random() % 2 == 0 ? std::round(real) : real;
        if (std::abs(frame.value[fap]) < least_fap_value) frame.value[fap] = 0.0;
      }
      const auto small = [&](std::uint32_t most) { return static_cast<std::uint8_t>(random() % (most + 1)); };
      if (random() % 2 == 0) {
        frame.present.set(1);
        frame.viseme = {small(14), small(14), small(63), small(1)};
      }
      if (random() % 2 == 0) {
        frame.present.set(2);
        frame.expression = {small(6), small(63), small(6), small(63), small(1), small(1)};
      }
      file.frames.push_back(frame);
    }
    const auto reading = read_fap_file(write_fap_file(file));
    ASSERT_TRUE(reading) << reading.error().where << " " << reading.error().message;
    ASSERT_EQ(reading->file, file);
  }
}

TEST(FapFile, Sentence_NamesLineAndTimes) {
  EXPECT_EQ(to_sentence({FapFileOddity::extra_flag, 2, 1}), "line 2: 69 flags instead of 68: the last is dropped");
  EXPECT_TRUE(to_sentence({FapFileOddity::not_finite, 9, 3}).ends_with(" (3 times)"));
}

TEST(FapFileSamples, RealFiles_AreReadAndWrittenExactly) {
  const char* const folder = std::getenv("SEMBLANTE_SAMPLES_DIR");
  if (folder == nullptr || !fs::is_directory(folder)) GTEST_SKIP() << "no folder of sample .fap files";
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".fap") continue;
    ++files;
    const auto first = read_fap_file(read(entry.path()));
    ASSERT_TRUE(first) << entry.path() << ": " << first.error().where << ": " << first.error().message;
    EXPECT_TRUE(first->warnings.empty()) << entry.path() << ": " << to_sentence(first->warnings.front());
    EXPECT_GT(first->file.frames.size(), 100U);
    const std::string written = write_fap_file(first->file);
    const auto second = read_fap_file(written);
    ASSERT_TRUE(second);
    EXPECT_EQ(second->file, first->file);
    EXPECT_EQ(write_fap_file(second->file), written);
  }
  EXPECT_GE(files, 1U);
}

}  // namespace
}  // namespace semblante

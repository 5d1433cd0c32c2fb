// The golden documents that every reader and evaluator of performances is held to.
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/performance/performance.h"
#include "protocol/cpp/json_codec.h"
#include "protocol/cpp/kernel_values.h"
#include "protocol/cpp/performance_document.h"

namespace semblante {
namespace {

std::string read_file(const std::string& name) {
  std::ifstream file(std::string(SEMBLANTE_SOURCE_DIR) + "/protocol/" + name);
  EXPECT_TRUE(file) << name;
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

Result<Performance> load(const std::string& text) {
  const auto script = read_performance(text);
  if (!script) return script.error();
  return Performance::compile(*script);
}

TEST(PerformanceVectors, Documents_AreTakenOrRefusedAtThePlace) {
  const auto documents = nlohmann::json::parse(read_file("vectors/performance/documents.json"));
  for (const auto& document : documents["good"]) {
    const auto made = read_performance(document.dump());
    EXPECT_TRUE(made) << document.dump() << ": " << (made ? "" : made.error().where + " " + made.error().message);
    // One without anything to play can be read and written; it is only not to be played.
    if (made && (!made->cues.empty() || made->idle)) {
      EXPECT_TRUE(Performance::compile(*made)) << document.dump();
    }
  }
  for (const auto& refused : documents["refused"]) {
    const auto made = load(refused["document"].dump());
    ASSERT_FALSE(made) << refused.dump();
    if (refused["where"] != "") {
      EXPECT_EQ(made.error().where, refused["where"].get<std::string>()) << refused.dump();
    }
  }
}

void expect_golden(const std::string& document, const std::string& golden) {
  const auto made = load(read_file(document));
  ASSERT_TRUE(made) << made.error().where << made.error().message;
  const auto frames = decode_json_values(read_file(golden));
  ASSERT_TRUE(frames) << frames.error().where << frames.error().message;
  ASSERT_GT(frames->size(), 50U);
  for (const auto& frame : *frames) {
    const auto face = to_values(made->frame_at(frame.time));
    EXPECT_EQ(face.viseme, frame.state.viseme) << document << " at " << frame.time;
    EXPECT_EQ(face.expression, frame.state.expression) << document << " at " << frame.time;
    for (std::size_t n = 3; n <= 68; ++n)
      EXPECT_NEAR(face.fap[n], frame.state.fap[n], 0.01) << document << " at " << frame.time << ", FAP " << n;
  }
}

TEST(PerformanceVectors, Frames_AreTheGoldenOnes) {
  expect_golden("vectors/performance/corners.json", "vectors/performance/corners.frames.json");
  expect_golden("examples/performances/hello.json", "vectors/performance/hello.frames.json");
}

}  // namespace
}  // namespace semblante

#include <cmath>
#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "clients/runtime/playout.h"

namespace semblante::testing {
namespace {

using Json = nlohmann::ordered_json;

const std::string file_name = SEMBLANTE_SOURCE_DIR "/protocol/vectors/clock/traces.json";

double rounded(double value) { return std::round(value * 1e6) / 1e6; }

struct Played {
  Json shown = Json::array(), begins = Json::array(), stats;
};

/// What protocol/vectors/README.md says of a trace.
Played play(const Json& trace) {
  runtime::PlayoutOptions options;
  if (trace["options"].contains("delay")) {
    options.delay = trace["options"]["delay"].get<double>();
  }
  options.eased = trace["options"].value("eased", false);
  runtime::Playout playout(options);
  Played played;
  for (const Json& event : trace["events"]) {
    const auto kind = event[0].get<std::string>();
    const auto number = [&](std::size_t i) { return event[i].get<double>(); };
    const double now = number(1);
    if (kind == "header") {
      Header header;
      header.epoch = event[3].get<std::uint64_t>();
      header.media_time = event[4].get<std::uint64_t>();
      header.fps_hint = number(5);
      header.batch_interval = event[6].get<std::uint32_t>();
      if (playout.begin(header)) {
        playout.clock().clear();
      }
      playout.clock().answered(number(2), now, number(4));
    } else if (kind == "answer") {
      playout.clock().answered(number(2), now, number(3));
    } else if (kind == "frames") {
      played.begins.push_back(rounded(playout.arrived(number(2), number(3), number(4), now)));
    } else {
      playout.advance(now, number(2));
      played.shown.push_back({rounded(playout.playhead()), rounded(playout.delay())});
    }
  }
  const runtime::PlayoutStats stats = playout.stats();
  const runtime::ClockEstimate& clock = playout.clock();
  played.stats = {{"starved", stats.starved},
                  {"starved_time", rounded(stats.starved_time)},
                  {"snaps", stats.snaps},
                  {"jitter", rounded(stats.jitter)},
                  {"wanted_delay", rounded(stats.wanted_delay)},
                  {"error", rounded(stats.error)},
                  {"uncertainty", rounded(clock.uncertainty().value_or(-1))},
                  {"drift_ppm", rounded(clock.drift() * 1e6)},
                  {"steps", clock.steps()}};
  return played;
}

/// With SEMBLANTE_WRITE_VECTORS set the file gets what this program plays, for a change that is meant.
void write(Json& traces) {
  std::ofstream file(file_name);
  const char* between = "[\n";
  for (Json& trace : traces) {
    const Played played = play(trace);
    file << between << " {\"name\": " << trace["name"] << ", \"options\": " << trace["options"] << ",\n  \"events\": [";
    const auto list = [&](const Json& items) {
      const char* comma = "\n   ";
      for (const Json& item : items) {
        file << comma << item;
        comma = ",\n   ";
      }
    };
    list(trace["events"]);
    file << "],\n  \"begins\": " << played.begins << ",\n  \"shown\": [";
    list(played.shown);
    file << "],\n  \"stats\": " << played.stats << "}";
    between = ",\n";
  }
  file << "\n]\n";
}

TEST(Playout, GoldenTraces_AreShownAsTheFileSays) {
  std::ifstream file(file_name);
  ASSERT_TRUE(file) << file_name;
  Json traces = Json::parse(file);
  if (std::getenv("SEMBLANTE_WRITE_VECTORS") != nullptr) {
    write(traces);
    GTEST_SKIP() << "written";
  }
  ASSERT_GE(traces.size(), 12U);
  for (const Json& trace : traces) {
    SCOPED_TRACE(trace["name"].get<std::string>());
    const Played played = play(trace);
    EXPECT_EQ(played.stats["starved"], trace["stats"]["starved"]);
    ASSERT_EQ(played.shown.size(), trace["shown"].size());
    ASSERT_EQ(played.begins.size(), trace["begins"].size());
    for (std::size_t i = 0; i < played.begins.size(); ++i) {
      ASSERT_NEAR(played.begins[i].get<double>(), trace["begins"][i].get<double>(), 1e-5) << "arrival " << i;
    }
    double before = -1;
    for (std::size_t i = 0; i < played.shown.size(); ++i) {
      for (std::size_t k = 0; k < 2; ++k) {
        const Json& expected = trace["shown"][i][k];
        const Json& actual = played.shown[i][k];
        if (expected.is_null()) {  // before the first frame
          ASSERT_TRUE(std::isnan(actual.get<double>()) || actual.is_null()) << i;
          continue;
        }
        ASSERT_NEAR(actual.get<double>(), expected.get<double>(), 1e-5) << "display frame " << i;
      }
      if (trace["name"] != "another epoch" && !trace["shown"][i][0].is_null()) {
        ASSERT_GE(played.shown[i][0].get<double>(), before) << "never back";
        before = played.shown[i][0].get<double>();
      }
    }
    for (const auto& [name, value] : trace["stats"].items()) {
      EXPECT_NEAR(played.stats[name].get<double>(), value.get<double>(), 1e-5) << name;
    }
  }
}

}  // namespace
}  // namespace semblante::testing

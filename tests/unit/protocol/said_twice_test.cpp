// What documents and generated TypeScript say again of limits, usual times and counts, against the constants in C++.

#include <cctype>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/performance/cue.h"
#include "core/performance/usual_times.h"
#include "core/tables/mpeg4.h"
#include "protocol/cpp/performance_document.h"

namespace semblante {
namespace {

std::string source(const std::string& path) {
  std::ifstream file(SEMBLANTE_SOURCE_DIR "/" + path);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The numbers of a TypeScript constant: `const name = 16 * 1024;` gives 16384, `name: [1, 2]` gives nothing.
double typescript_number(const std::string& text, const std::string& name) {
  std::smatch found;
  if (!std::regex_search(text, found, std::regex("const " + name + " = ([0-9_* ]+);"))) {
    ADD_FAILURE() << "no number " << name;
    return 0.0;
  }
  double product = 1.0;
  std::string digits;
  for (const char c : found[1].str() + "*") {
    if (std::isdigit(static_cast<unsigned char>(c)) != 0) digits += c;
    if (c == '*') {
      product *= std::stod(digits);
      digits.clear();
    }
  }
  return product;
}

std::string pair_text(const Ramps& ramps) {
  std::ostringstream text;
  text << ramps.attack << ", " << ramps.release;
  return text.str();
}

TEST(SaidTwice, LimitsOfPerformances) {
  const auto schema = nlohmann::json::parse(source("protocol/schema/performance.schema.json"));
  EXPECT_EQ(schema["properties"]["cues"]["maxItems"], max_performance_cues);
  const std::string spec = source("protocol/SPEC.md");
  EXPECT_EQ(max_performance_cues, 100'000U);
  EXPECT_NE(spec.find("| `cues` | at most 100,000,"), std::string::npos);
  EXPECT_NE(spec.find("At most " + std::to_string(max_overlapping_cues) + " at once."), std::string::npos);
}

TEST(SaidTwice, UsualTimesOfCues_AndHowFarLidsAndEyesGo) {
  const std::string spec = source("protocol/SPEC.md");
  for (const auto& [target, ramps] : usual_ramps) {
    const std::string name(target);
    const std::size_t row = spec.find("\n| `" + name + "`:");
    ASSERT_NE(row, std::string::npos) << name;
    const std::string line = spec.substr(row + 1, spec.find('\n', row + 1) - row);
    EXPECT_NE(line.find("| " + pair_text(ramps) + " "), std::string::npos) << line;
  }
  std::ostringstream blink, lids, eyes;
  blink << "(`duration` " << blink_ms << ")";
  lids << "towards " << upper_lid_units << " (upper) and " << lower_lid_units << " (lower) units";
  eyes << "An eye turns at most " << largest_eye_yaw_degrees << " degrees sideways, " << largest_eye_pitch_degrees
       << " up or down.";
  EXPECT_NE(spec.find(eyes.str()), std::string::npos);
  EXPECT_NE(spec.find(blink.str()), std::string::npos);
  EXPECT_NE(spec.find(lids.str()), std::string::npos);
}

/// Texts for people say "68" and "84"; code takes them from core/tables.
TEST(SaidTwice, NumbersOfFapsAndFeaturePoints) {
  EXPECT_EQ(mpeg4::fap_count, 68U);
  EXPECT_EQ(mpeg4::feature_points.size(), 84U);
  const std::string generated = source("protocol/ts/generated/mpeg4.ts");
  EXPECT_EQ(typescript_number(generated, "fapCount"), mpeg4::fap_count);
  EXPECT_EQ(typescript_number(generated, "featurePointCount"), mpeg4::feature_points.size());
}

}  // namespace
}  // namespace semblante

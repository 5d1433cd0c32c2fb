#include "core/types/feature_point_id.h"

#include <gtest/gtest.h>

namespace semblante {
namespace {

TEST(FeaturePointId, ItsText_IsReadAsTheSamePoint) {
  for (std::uint8_t i = 0; i < feature_point_count; ++i) {
    const FeaturePointId id(i);
    EXPECT_EQ(parse_feature_point(to_string(id)), id) << to_string(id);
    EXPECT_EQ(to_string(id), std::to_string(group_of(id)) + "." + std::to_string(number_of(id)));
  }
}

TEST(FeaturePointId, OtherText_IsNoPoint) {
  for (const char* text :
       {"",    ".",    "2",     "2.",    ".1",           "2.0",  "2.01", "02.1", "2.15", "2.1.1", "2..1",
        "1.1", "12.1", "2.100", "200.1", "2.4294967297", "+2.1", "-2.1", " 2.1", "2.1 ", "2,1",   "2.a"}) {
    EXPECT_FALSE(parse_feature_point(text)) << text;
  }
}

}  // namespace
}  // namespace semblante

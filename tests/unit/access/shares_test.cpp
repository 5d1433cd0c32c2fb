#include "server/access/shares.h"

#include <gtest/gtest.h>

namespace semblante::access {
namespace {

TEST(Shares, AreGivenBackWithTheLastCopy_ForEachClientByItself) {
  Shares shares;
  auto first = shares.take("a", 2);
  const auto second = shares.take("a", 2);
  ASSERT_TRUE(first && second);
  EXPECT_FALSE(shares.take("a", 2));
  EXPECT_TRUE(shares.take("b", 2));
  auto copy = first;
  first.reset();
  EXPECT_FALSE(shares.take("a", 2));
  copy.reset();
  EXPECT_EQ(shares.of("a"), 1U);
  EXPECT_TRUE(shares.take("a", 2));
  EXPECT_FALSE(shares.take("c", 0));
  EXPECT_EQ(shares.of("c"), 0U);
}

}  // namespace
}  // namespace semblante::access

#include "clients/runtime/sha256.h"

#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "protocol/hash/sha256.h"

namespace semblante::testing {
namespace {

TEST(RuntimeSha256, EveryLength_IsThatOfOpenSsl) {
  std::mt19937 random(1);
  std::vector<std::uint8_t> bytes;
  for (std::size_t size = 0; size < 300; ++size) {
    EXPECT_EQ(runtime::sha256(bytes), semblante::sha256(bytes)) << size;
    bytes.push_back(static_cast<std::uint8_t>(random()));
  }
  bytes.resize(100'000, 0xA5);
  EXPECT_EQ(runtime::sha256(bytes), semblante::sha256(bytes));
}

}  // namespace
}  // namespace semblante::testing

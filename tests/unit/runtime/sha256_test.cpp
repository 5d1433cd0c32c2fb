#include "clients/runtime/sha256.h"

#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "clients/runtime/semblante.h"
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

TEST(RuntimeSha256, AtTheBorder_IsTheSame) {
  const std::vector<std::uint8_t> bytes(1000, 7);
  Sha256 digest{};
  ASSERT_EQ(semblante_sha256(bytes.data(), bytes.size(), digest.data()), SEMBLANTE_OK);
  EXPECT_EQ(digest, semblante::sha256(bytes));
  EXPECT_EQ(semblante_sha256(nullptr, 0, digest.data()), SEMBLANTE_OK);
  EXPECT_EQ(digest, semblante::sha256(std::vector<std::uint8_t>{}));
  EXPECT_EQ(semblante_sha256(nullptr, 1, digest.data()), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_sha256(bytes.data(), 1, nullptr), SEMBLANTE_INVALID_ARGUMENT);
}

}  // namespace
}  // namespace semblante::testing

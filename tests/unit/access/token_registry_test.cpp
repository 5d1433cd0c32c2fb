#include "server/access/token_registry.h"

#include <gtest/gtest.h>

#include "server/access/new_token.h"

namespace semblante::access {
namespace {

class Tokens : public store::TokenStore {
 public:
  void add_token(const store::TokenRecord& token) override { list.push_back(token); }
  std::vector<store::TokenRecord> tokens() override { return list; }
  bool remove_token(std::string_view id) override {
    return std::erase_if(list, [&](const auto& token) { return token.id == id; }) > 0;
  }
  std::int64_t changes_by_others() override { return changes; }

  std::vector<store::TokenRecord> list;
  std::int64_t changes = 0;
};

class RegistryTest : public ::testing::Test {
 protected:
  NewToken add(const TokenWish& wish = {}) {
    auto made = make_token(wish);
    store_.add_token(made.record);
    registry_.load(store_);
    return made;
  }
  Tokens store_;
  std::int64_t now_ = 1'000;
  TokenRegistry registry_{[this] { return now_; }};
};

TEST_F(RegistryTest, Token_IsAcceptedWithItsRights) {
  const auto made = add({"stage", Scope::publish, "demo", {}, {}});
  for (int i = 0; i < 3; ++i) {
    const auto verified = registry_.verify(made.text);
    ASSERT_EQ(verified.verdict, Verdict::accepted);
    EXPECT_EQ(verified.rights.scope, Scope::publish);
    EXPECT_EQ(verified.rights.stream, "demo");
    EXPECT_EQ(verified.rights.token, made.record.id);
    EXPECT_FALSE(*verified.rights.ended);
  }
}

TEST_F(RegistryTest, OtherTexts_AreUnknown) {
  const auto made = add();
  registry_.verify(made.text);
  EXPECT_EQ(registry_.verify("").verdict, Verdict::unknown);
  EXPECT_EQ(registry_.verify(to_text({made.record.id, random_secret()})).verdict, Verdict::unknown);
  EXPECT_EQ(registry_.verify(make_token({}).text).verdict, Verdict::unknown);
}

TEST_F(RegistryTest, RevokedToken_IsUnknown_AndItsRightsEnd) {
  const auto made = add();
  const auto other = add();
  const auto rights = registry_.verify(made.text).rights;
  store_.remove_token(made.record.id);
  registry_.load(store_);
  EXPECT_TRUE(*rights.ended);
  EXPECT_EQ(registry_.verify(made.text).verdict, Verdict::unknown);
  EXPECT_EQ(registry_.verify(other.text).verdict, Verdict::accepted);
}

TEST_F(RegistryTest, ExpiredToken_IsToldSo_AndItsRightsEnd) {
  auto made = make_token({});
  made.record.expires = now_ + 10;
  store_.add_token(made.record);
  registry_.load(store_);
  const auto rights = registry_.verify(made.text).rights;
  now_ += 10;
  EXPECT_EQ(registry_.verify(made.text).verdict, Verdict::expired);
  EXPECT_FALSE(*rights.ended);
  registry_.refresh(store_);
  EXPECT_TRUE(*rights.ended);
  EXPECT_EQ(registry_.verify(to_text({made.record.id, random_secret()})).verdict, Verdict::unknown)
      << "only its owner learns that there was one";
}

TEST_F(RegistryTest, ClockSetBack_BeforeTheEndOfAToken_GivesRightsAnew) {
  auto made = make_token({});
  made.record.expires = now_ + 10;
  store_.add_token(made.record);
  registry_.load(store_);
  const auto before = registry_.verify(made.text).rights;
  now_ += 1000;  // set wrong, as by a clock without a battery
  registry_.refresh(store_);
  now_ -= 1000;
  const auto after = registry_.verify(made.text).rights;
  registry_.refresh(store_);
  EXPECT_TRUE(*before.ended) << "its connections are closed";
  EXPECT_FALSE(*after.ended) << "new ones are not";
}

TEST_F(RegistryTest, ChangesByAnotherProgram_AreSeenAtTheNextRefresh) {
  const auto made = make_token({});
  store_.add_token(made.record);
  registry_.refresh(store_);
  EXPECT_EQ(registry_.verify(made.text).verdict, Verdict::unknown);
  store_.changes = 1;
  registry_.refresh(store_);
  EXPECT_EQ(registry_.verify(made.text).verdict, Verdict::accepted);
}

TEST_F(RegistryTest, ManyWrongSecrets_CostBoundedTime_AndTheOwnerGoesOn) {
  const auto made = add();
  ASSERT_EQ(registry_.verify(made.text).verdict, Verdict::accepted);
  int looked_at = 0;
  for (int i = 0; i < 1000; ++i)
    looked_at += registry_.verify(to_text({made.record.id, std::string(43, 'a')})).verdict == Verdict::unknown ? 1 : 0;
  EXPECT_LT(looked_at, 1000) << "each takes milliseconds of a thread that serves everybody";
  EXPECT_EQ(registry_.verify(made.text).verdict, Verdict::accepted);
}

}  // namespace
}  // namespace semblante::access

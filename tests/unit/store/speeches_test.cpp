#include <gtest/gtest.h>

#include "tests/unit/store/store_fixture.h"

namespace semblante::store {
namespace {

SpeechRecord speech(const std::string& id, const std::string& hash, const std::string& owner = "") {
  return {id,
          "t",
          R"({"text":"a"})",
          "a",
          "voice 1",
          900,
          {"a warning"},
          {{"audio", hash, 40, "audio/wav"}, {"captions", std::string(64, '7'), 5, "text/vtt"}},
          owner};
}

TEST_F(StoreTest, Speeches_AreKeptWithTheirFiles_WhichGoWithTheLast) {
  const auto first = speech("s1", std::string(64, '1'), "o");
  const IdempotencyRecord key{"key", "print", "s1"};
  store_->create_speech(first, key);
  store_->create_speech(speech("s2", std::string(64, '2')), std::nullopt);
  reopen();
  EXPECT_EQ(store_->speech("s1"), first);
  EXPECT_EQ(store_->idempotency("key"), key);
  EXPECT_FALSE(store_->speech("absent"));
  EXPECT_EQ(store_->speech_count(), 2U);
  EXPECT_EQ(store_->speeches("", 1)->front(), first);
  EXPECT_EQ(store_->speeches("s1", 5)->front().id, "s2");
  EXPECT_FALSE(store_->speeches("absent", 5));
  EXPECT_EQ(store_->referenced_hashes(),
            (std::vector<std::string>{std::string(64, '1'), std::string(64, '2'), std::string(64, '7')}));
  EXPECT_EQ(store_->users_of(std::string(64, '1')), std::vector<std::string>{"speech s1"});
  EXPECT_EQ(store_->artefact_bytes(), 85U);
  EXPECT_EQ(store_->usage_of("o").speeches, 1U);
  EXPECT_EQ(store_->usage_of("o").bytes, 45U);
  EXPECT_EQ(store_->usage_of("other").bytes, 0U);

  EXPECT_FALSE(store_->remove_speech("absent"));
  EXPECT_EQ(store_->remove_speech("s1"), std::vector<std::string>{std::string(64, '1')}) << "the other is still used";
  reopen();
  EXPECT_FALSE(store_->speech("s1"));
  EXPECT_EQ(store_->remove_speech("s2"), (std::vector<std::string>{std::string(64, '2'), std::string(64, '7')}));
  EXPECT_TRUE(store_->referenced_hashes().empty());
}

}  // namespace
}  // namespace semblante::store

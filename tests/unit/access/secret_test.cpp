#include "server/access/secret.h"

#include <set>

#include <gtest/gtest.h>

#include "server/access/new_token.h"

namespace semblante::access {
namespace {

TEST(Secret, Text_IsReadBack) {
  const TokenText token{"abc234", random_secret()};
  const auto read = parse_token(to_text(token));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->id, token.id);
  EXPECT_EQ(read->secret, token.secret);
}

TEST(Secret, OtherTexts_AreNoTokens) {
  const auto secret = random_secret();
  for (const auto& text : {std::string(), std::string("smb_"), "smb__" + secret, "smb_abc" + secret, "abc_" + secret,
                           "smb_abc_" + secret + "x", "smb_abc_" + secret.substr(1), "smb_abc_ " + secret.substr(1),
                           "smb_" + std::string(100, 'a') + "_" + secret})
    EXPECT_FALSE(parse_token(text)) << text;
}

TEST(Secret, Secrets_Differ) {
  std::set<std::string> seen;
  for (int i = 0; i < 100; ++i) seen.insert(random_secret());
  EXPECT_EQ(seen.size(), 100U);
}

TEST(Secret, Hash_MatchesItsSecretAlone) {
  const auto secret = random_secret();
  const auto hash = hash_secret(secret);
  EXPECT_EQ(hash.find(secret), std::string::npos);
  EXPECT_TRUE(matches_hash(secret, hash));
  EXPECT_FALSE(matches_hash(random_secret(), hash));
  EXPECT_NE(hash, hash_secret(secret)) << "each has its own salt";
  EXPECT_FALSE(matches_hash(secret, ""));
  EXPECT_FALSE(matches_hash(secret, hash.substr(0, hash.size() - 1)));
  EXPECT_FALSE(matches_hash(secret, "plain$" + secret));
}

TEST(Secret, NewToken_KeepsOnlyTheHash) {
  const auto made = make_token({"stage", Scope::publish, "demo", {}, 60});
  const auto text = parse_token(made.text);
  ASSERT_TRUE(text);
  EXPECT_EQ(text->id, made.record.id);
  EXPECT_TRUE(matches_hash(text->secret, made.record.secret_hash));
  EXPECT_EQ(made.record.scope, "publish");
  EXPECT_EQ(made.record.stream, "demo");
  EXPECT_TRUE(made.record.expires);
}

}  // namespace
}  // namespace semblante::access

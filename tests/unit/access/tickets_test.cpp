#include "server/access/tickets.h"

#include <gtest/gtest.h>

namespace semblante::access {
namespace {

TEST(Tickets, AreUsedOnce) {
  Tickets tickets;
  const auto ticket = tickets.issue({Scope::read, {}, {}, "abc"}, "/v1/streams/demo");
  ASSERT_TRUE(ticket);
  const auto rights = tickets.redeem(*ticket, "/v1/streams/demo");
  ASSERT_TRUE(rights);
  EXPECT_EQ(rights->scope, Scope::read);
  EXPECT_EQ(rights->token, "abc");
  EXPECT_FALSE(tickets.redeem(*ticket, "/v1/streams/demo"));
}

TEST(Tickets, AreForOnePathAndAShortTime) {
  Tickets tickets;
  const auto now = Tickets::Clock::now();
  const auto elsewhere = tickets.issue({Scope::admin}, "/v1/models/a", now);
  EXPECT_FALSE(tickets.redeem(*elsewhere, "/v1/models/b", now));
  EXPECT_FALSE(tickets.redeem(*elsewhere, "/v1/models/a", now)) << "a try uses it up";
  const auto late = tickets.issue({Scope::admin}, "/v1/models/a", now);
  EXPECT_FALSE(tickets.redeem(*late, "/v1/models/a", now + Tickets::lifetime));
  EXPECT_FALSE(tickets.redeem("", "/v1/models/a", now));
}

TEST(Tickets, TooMany_AreRefusedUntilOldOnesEnd) {
  Tickets tickets;
  const auto now = Tickets::Clock::now();
  for (std::size_t i = 0; i < Tickets::most; ++i) ASSERT_TRUE(tickets.issue({}, "/", now));
  EXPECT_FALSE(tickets.issue({}, "/", now));
  EXPECT_TRUE(tickets.issue({}, "/", now + Tickets::lifetime));
}

}  // namespace
}  // namespace semblante::access

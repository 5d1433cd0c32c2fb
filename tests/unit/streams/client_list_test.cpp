#include "server/streams/client_list.h"

#include <gtest/gtest.h>

namespace semblante::streams {
namespace {

using std::chrono::seconds;

struct Client : StreamPeer {
  bool close(const Message&, http::CloseReason) override { return true; }
};

TEST(ClientList, WhoLeaves_IsGivenBack_TheOthersKnowTheirPlaces) {
  ClientList list;
  std::vector<std::shared_ptr<Client>> clients;
  for (int i = 0; i < 4; ++i) list.add(clients.emplace_back(std::make_shared<Client>()), {});
  EXPECT_EQ(list.remove(*clients[1]), clients[1]);
  EXPECT_EQ(list.remove(*clients[1]), nullptr) << "once";
  EXPECT_EQ(list.remove(*clients[3]), clients[3]);
  ASSERT_EQ(list.size(), 2U);
  for (const auto* client : {&clients[0], &clients[2]}) EXPECT_EQ(list.all()[(*client)->notes().client], *client);
}

TEST(ClientList, WhoLeavesDuringASlice_LivesUntilItsEnd) {
  ClientList list;
  auto client = std::make_shared<Client>();
  const std::weak_ptr<Client> alive = client;
  list.add(client, {});
  list.begin_slice();
  EXPECT_EQ(list.remove(*client), nullptr);
  client.reset();
  EXPECT_EQ(list.size(), 0U);
  EXPECT_FALSE(alive.expired());
  EXPECT_EQ(list.end_slice().size(), 1U);
  EXPECT_TRUE(alive.expired());
}

TEST(ClientList, Silent_AreThoseWithoutAHelloInTime_Once) {
  ClientList list;
  const ClientList::Clock::time_point began{};
  std::vector<std::shared_ptr<Client>> clients;
  for (int i = 0; i < 4; ++i) list.add(clients.emplace_back(std::make_shared<Client>()), began + seconds(i));
  clients[1]->notes().said_hello = true;
  list.remove(*clients[2]);
  clients[2].reset();
  EXPECT_TRUE(list.silent(seconds(10), began + seconds(10)).empty()) << "not yet";
  const auto silent = list.silent(seconds(10), began + seconds(13));
  ASSERT_EQ(silent.size(), 1U);
  EXPECT_EQ(silent[0], clients[0]);
  EXPECT_EQ(list.silent(seconds(10), began + seconds(14)).size(), 1U) << "the last one; the first not again";
}

}  // namespace
}  // namespace semblante::streams

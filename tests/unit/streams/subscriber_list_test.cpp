#include "server/streams/subscriber_list.h"

#include <map>
#include <random>

#include <gtest/gtest.h>

namespace semblante::streams {
namespace {

TEST(SubscriberList, PassVisitsEveryoneWhoStaysExactlyOnce_WhoeverComesAndGoes) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    SubscriberList list;
    // Stable places for what the list writes to; `next_batch` tells who is who.
    std::vector<std::size_t> slots(400, Subscriber::nowhere);
    std::uint64_t next = 0;
    const auto add = [&] {
      Subscriber subscriber;
      subscriber.slot = &slots[next];
      subscriber.next_batch = next++;
      list.add(subscriber);
    };
    for (int i = 0; i < 40; ++i) add();
    std::map<std::uint64_t, int> visits;
    list.begin_pass();
    while (!list.pass_done()) {
      for (const auto& subscriber : list.next(1 + random() % 4)) ++visits[subscriber.next_batch];
      for (unsigned i = random() % 4; i > 0 && list.size() > 0; --i) list.remove(random() % list.size());
      for (unsigned i = random() % 3; i > 0 && next < slots.size(); --i) add();
    }
    for (std::size_t id = 0; id < next; ++id) {
      if (slots[id] == Subscriber::nowhere) {
        EXPECT_LE(visits[id], 1);
        continue;
      }
      ASSERT_LT(slots[id], list.size());
      EXPECT_EQ(list[slots[id]].next_batch, id) << "each knows its place";
      EXPECT_EQ(visits[id], 1) << "who came meanwhile is met at the end of the pass";
    }
  }
}

}  // namespace
}  // namespace semblante::streams

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <deque>
#include <fcntl.h>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include "server/net/ring_sender.h"
#include "server/net/submission_ring.h"
#include "tests/unit/net/outbox_ends.h"

namespace semblante::net {
namespace {

using http::Purpose;
using http::Sent;

/// An outbox and the client's end of its connection, which may have little room.
struct Connection {
  Connection() {
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()), 0);
    const int size = 8192;
    EXPECT_EQ(::setsockopt(ends[0], SOL_SOCKET, SO_SNDBUF, &size, sizeof size), 0);
    outbox = std::make_shared<Outbox>(ends[0], http::OutboxLimits{}, owner);
  }
  ~Connection() {
    ::close(ends[0]);
    ::close(ends[1]);
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  std::string read() const {
    std::string all;
    std::array<char, 4096> piece{};
    ssize_t count = 0;
    while ((count = ::recv(ends[1], piece.data(), piece.size(), MSG_DONTWAIT)) > 0)
      all.append(piece.data(), static_cast<std::size_t>(count));
    return all;
  }
  std::string read_to_the_end() const {
    std::string all = read();
    while (outbox->flush() == Outbox::Flushed::some) all += read();
    return all + read();
  }

  std::array<int, 2> ends{};
  std::shared_ptr<Owner> owner = std::make_shared<Owner>();
  std::shared_ptr<Outbox> outbox;
};

using Make = std::function<std::unique_ptr<http::GroupSender>()>;

class GroupSenderTest : public ::testing::TestWithParam<Make> {
 protected:
  /// To all connections, the same message.
  std::vector<Sent> send(const http::SharedWire& message) {
    std::vector<http::Delivery> group;
    for (const auto& connection : connections_) group.push_back({connection.outbox.get(), &message, Sent::refused});
    sender_->send(group);
    std::vector<Sent> sent;
    for (const auto& delivery : group) sent.push_back(delivery.sent);
    return sent;
  }

  std::unique_ptr<http::GroupSender> sender_ = GetParam()();
  std::deque<Connection> connections_;
};

TEST_P(GroupSenderTest, More_ThanGoAtOnce_GetItAllOfThem) {
  connections_.resize(200);
  for (const std::string bytes : {"first", "second"})
    EXPECT_EQ(send(wire(bytes)), std::vector(connections_.size(), Sent::handed));
  for (const auto& connection : connections_) EXPECT_EQ(connection.read(), "firstsecond");
}

TEST_P(GroupSenderTest, FullSockets_HoldBackOnlyTheirOwn) {
  connections_.resize(3);
  const std::string large(100'000, 'x');
  connections_[1].outbox->send(wire(large), Purpose::answer);
  ASSERT_FALSE(connections_[1].outbox->idle());
  EXPECT_EQ(send(wire("next")), (std::vector{Sent::handed, Sent::waits, Sent::handed}));
  EXPECT_EQ(connections_[0].read(), "next");
  EXPECT_EQ(connections_[1].read_to_the_end(), large + "next");
}

TEST_P(GroupSenderTest, MessageThatFitsInPart_IsCompletedWhenThereIsRoom) {
  connections_.resize(2);
  std::string large;
  for (int i = 0; i < 20'000; ++i) large += std::to_string(i);
  EXPECT_EQ(send(wire(large)), std::vector(2, Sent::waits));
  for (const auto& connection : connections_) {
    EXPECT_EQ(connection.owner->blocked, 1);
    EXPECT_EQ(connection.read_to_the_end(), large);
  }
}

TEST_P(GroupSenderTest, ConnectionsThatAreGone_AreTold_AndTheOthersGetTheirs) {
  connections_.resize(4);
  ::shutdown(connections_[1].ends[1], SHUT_RDWR);
  connections_[2].outbox->detach();
  EXPECT_EQ(send(wire("x")), (std::vector{Sent::handed, Sent::closed, Sent::closed, Sent::handed}));
  EXPECT_EQ(send(wire("y")), (std::vector{Sent::handed, Sent::closed, Sent::closed, Sent::handed}));
  EXPECT_EQ(connections_[3].read(), "xy");
}

INSTANTIATE_TEST_SUITE_P(Senders, GroupSenderTest, ::testing::Values(Make(make_group_sender), Make([] {
                                                                       return std::make_unique<http::GroupSender>();
                                                                     })),
                         [](const auto& instance) { return instance.index == 0 ? "OfTheSystem" : "OneByOne"; });

/// The descriptors of this process that are rings.
std::set<int> rings() {
  std::set<int> found;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    std::error_code gone;  // the descriptor that lists them
    if (std::filesystem::read_symlink(entry.path(), gone).string().find("io_uring") != std::string::npos)
      found.insert(std::stoi(entry.path().filename()));
  }
  return found;
}

/// As in a process without a descriptor left; a system that forbids io_uring refuses in the same place.
TEST(GroupSenderFallback, NoRingAtTheBeginning_SendsOneByOne) {
  std::deque<Connection> connections(100);
  const auto before = rings();
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &limit), 0);
  const rlimit none{3, limit.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none), 0);
  const auto sender = make_group_sender();
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &limit), 0);
  EXPECT_EQ(rings(), before) << "the test has not kept the ring from being made";
  const auto message = wire("abc");
  std::vector<http::Delivery> group;
  for (const auto& connection : connections) group.push_back({connection.outbox.get(), &message, Sent::refused});
  sender->send(group);
  for (std::size_t i = 0; i < connections.size(); ++i) {
    EXPECT_EQ(group[i].sent, Sent::handed);
    EXPECT_EQ(connections[i].read(), "abc");
  }
}

TEST(GroupSenderFallback, RingThatFailsLater_LosesAndRepeatsNothing) {
  std::deque<Connection> connections(100);
  const auto before = rings();
  const auto sender = make_group_sender();
  std::vector<int> made;
  const auto after = rings();
  std::set_difference(after.begin(), after.end(), before.begin(), before.end(), std::back_inserter(made));
  if (made.empty()) GTEST_SKIP() << "no io_uring here";
  ASSERT_EQ(made.size(), 1U);
  std::string sent;
  for (const std::string bytes : {"first", "second", "third"}) {
    if (bytes == "second") {
      // Its descriptor is another file now: every further call of the ring fails.
      const int other = ::open("/dev/null", O_RDWR | O_CLOEXEC);
      ASSERT_EQ(::dup2(other, made.front()), made.front());
      ::close(other);
    }
    sent += bytes;
    const auto message = wire(bytes);
    std::vector<http::Delivery> group;
    for (const auto& connection : connections) group.push_back({connection.outbox.get(), &message, Sent::refused});
    sender->send(group);
    for (const auto& delivery : group) EXPECT_EQ(delivery.sent, Sent::handed);
  }
  for (const auto& connection : connections) EXPECT_EQ(connection.read(), sent);
}

TEST(SubmissionRing, Sends_WithTheResultOfEachCall) {
  auto ring = SubmissionRing::make(4);
  if (!ring) GTEST_SKIP() << "no io_uring here";
  Connection connection, gone;
  ::shutdown(gone.ends[1], SHUT_RDWR);
  for (int round = 0; round < 3; ++round) {  // past the end of the ring's memory
    ring->add_send(connection.ends[0], "abc", 7);
    ring->add_send(gone.ends[0], "abc", 8);
    ring->add_send(-1, "abc", 9);
    std::array<long, 10> results{};
    EXPECT_EQ(ring->submit([&](std::size_t number, long result) { results.at(number) = result; }), 0);
    EXPECT_EQ(results[7], 3);
    EXPECT_EQ(results[8], -EPIPE);
    EXPECT_EQ(results[9], -EBADF);
  }
  EXPECT_EQ(connection.read(), "abcabcabc");
}

// ---- between begin_send() and end_send()

TEST(OutboxHanding, MessagesThatComeMeanwhile_GoBehind) {
  const Connection connection;
  std::mutex handing;
  const std::lock_guard lock(handing);
  const auto first = wire("12345");
  ASSERT_EQ(connection.outbox->begin_send(first, handing).descriptor, connection.ends[0]);
  EXPECT_EQ(connection.outbox->send_control("pong"), Sent::waits);
  EXPECT_EQ(connection.outbox->flush(), Outbox::Flushed::some) << "it would overtake";
  EXPECT_FALSE(connection.outbox->idle());
  EXPECT_EQ(connection.owner->blocked, 0);
  ASSERT_EQ(::send(connection.ends[0], "123", 3, 0), 3);
  EXPECT_EQ(connection.outbox->end_send(first, 3), Sent::waits);
  EXPECT_EQ(connection.owner->blocked, 1) << "somebody must flush it";
  EXPECT_EQ(connection.read_to_the_end(), "12345pong");
}

TEST(OutboxHanding, WholeMessage_LeavesWhatCameMeanwhileToBeFlushed) {
  const Connection connection;
  std::mutex handing;
  const std::lock_guard lock(handing);
  const auto first = wire("12345");
  ASSERT_GE(connection.outbox->begin_send(first, handing).descriptor, 0);
  EXPECT_EQ(connection.outbox->send(wire("next"), Purpose::answer), Sent::waits);
  ASSERT_EQ(::send(connection.ends[0], "12345", 5, 0), 5);
  EXPECT_EQ(connection.outbox->end_send(first, 5), Sent::handed);
  EXPECT_EQ(connection.owner->blocked, 1);
  EXPECT_EQ(connection.read_to_the_end(), "12345next");
  EXPECT_TRUE(connection.outbox->idle());
}

/// The descriptor may belong to another connection afterwards.
TEST(OutboxHanding, Detaching_WaitsForTheEnd) {
  const Connection connection;
  std::mutex handing;
  std::atomic<bool> ended{false}, before{false};
  const auto message = wire("12345");
  std::unique_lock lock(handing);
  ASSERT_GE(connection.outbox->begin_send(message, handing).descriptor, 0);
  std::thread closing([&] {
    connection.outbox->detach();
    before = !ended;
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  ASSERT_EQ(::send(connection.ends[0], "12345", 5, 0), 5);
  ended = true;
  EXPECT_EQ(connection.outbox->end_send(message, 5), Sent::handed);
  lock.unlock();
  closing.join();
  EXPECT_FALSE(before);
  EXPECT_TRUE(connection.outbox->detached());
}

}  // namespace
}  // namespace semblante::net

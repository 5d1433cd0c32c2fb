#include "server/net/outbox.h"

#include <array>
#include <atomic>
#include <fcntl.h>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>
#include <sys/socket.h>

#include "tests/unit/net/outbox_ends.h"

namespace semblante::net {
namespace {

using http::Purpose;
using http::Sent;

/// An outbox on one end of a pair of sockets with a small buffer, and a client that reads when it is told to.
class OutboxTest : public ::testing::Test {
 protected:
  OutboxTest() {
    limits_.messages = 4;
    limits_.bytes = 100'000;
    limits_.answers = 8;
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends_.data()), 0);
    const int size = 8192;
    EXPECT_EQ(::setsockopt(ends_[0], SOL_SOCKET, SO_SNDBUF, &size, sizeof size), 0);
    outbox_ = std::make_shared<Outbox>(ends_[0], limits_, owner_);
  }
  ~OutboxTest() override {
    ::close(ends_[0]);
    ::close(ends_[1]);
  }
  /// All that is there.
  std::string read() {
    std::string all;
    std::array<char, 4096> piece{};
    ssize_t count = 0;
    while ((count = ::recv(ends_[1], piece.data(), piece.size(), MSG_DONTWAIT)) > 0)
      all.append(piece.data(), static_cast<std::size_t>(count));
    return all;
  }
  std::string read_to_the_end() {
    std::string all = read();
    while (outbox_->flush() == Outbox::Flushed::some) all += read();
    return all + read();
  }
  /// Until the kernel takes no more. What was sent.
  std::string fill(std::size_t piece = 1000) {
    std::string sent;
    for (char c = 'a'; outbox_->idle(); c = c == 'z' ? 'a' : static_cast<char>(c + 1)) {
      const std::string bytes(piece, c);
      EXPECT_NE(outbox_->send(wire(bytes), Purpose::answer), Sent::closed);
      sent += bytes;
    }
    return sent;
  }

  http::OutboxLimits limits_;
  std::array<int, 2> ends_{};
  std::shared_ptr<Owner> owner_ = std::make_shared<Owner>();
  std::shared_ptr<Outbox> outbox_;
};

TEST_F(OutboxTest, WhatTheKernelTakes_GoesAtOnce) {
  EXPECT_EQ(outbox_->send(wire("one"), Purpose::state), Sent::handed);
  EXPECT_EQ(outbox_->send_control("two"), Sent::handed);
  EXPECT_EQ(outbox_->send(wire("three"), Purpose::answer), Sent::handed);
  EXPECT_EQ(read(), "onetwothree");
  EXPECT_TRUE(outbox_->idle());
  EXPECT_EQ(owner_->blocked, 0);
  EXPECT_FALSE(outbox_->stalled_since());
}

TEST_F(OutboxTest, PartialWrites_KeepOrderAndBytes) {
  // Longer than the kernel holds: it goes in parts, with a control frame and more behind it.
  std::string sent;
  for (int i = 0; i < 40'000; ++i) sent.push_back(static_cast<char>(i * 31 + i / 256));
  EXPECT_EQ(outbox_->send(wire(sent), Purpose::state), Sent::waits);
  EXPECT_EQ(outbox_->send_control("\x8A\x01x"), Sent::waits);
  EXPECT_EQ(outbox_->send(wire("last"), Purpose::state), Sent::waits);
  EXPECT_EQ(owner_->blocked, 1) << "one wait is enough";
  EXPECT_TRUE(outbox_->stalled_since());
  EXPECT_EQ(outbox_->flush(), Outbox::Flushed::some) << "nothing was read";
  EXPECT_EQ(read_to_the_end(), sent + "\x8A\x01x" + "last");
  EXPECT_TRUE(outbox_->idle());
  EXPECT_EQ(outbox_->send(wire("again"), Purpose::state), Sent::handed);
  fill();
  EXPECT_EQ(owner_->blocked, 2);
}

TEST_F(OutboxTest, State_IsBoundedAndReplaceable_AnswersStay) {
  const auto before = fill();
  std::size_t taken = 0;
  while (outbox_->send(wire("state"), Purpose::state) == Sent::waits) ++taken;
  EXPECT_EQ(taken, limits_.messages);
  EXPECT_EQ(outbox_->send(wire("answer"), Purpose::answer), Sent::waits);
  EXPECT_EQ(outbox_->drop_state(), taken);
  EXPECT_EQ(outbox_->send(wire("new"), Purpose::state), Sent::waits) << "there is room again";
  EXPECT_EQ(read_to_the_end(), before + "answer" + "new");
}

TEST_F(OutboxTest, State_IsBoundedInBytes_ButOneMayBeLonger) {
  fill();
  EXPECT_EQ(outbox_->send(wire(std::string(200'000, 'x')), Purpose::state), Sent::waits);
  EXPECT_EQ(outbox_->send(wire("y"), Purpose::state), Sent::refused);
}

TEST_F(OutboxTest, Answers_AreBounded) {
  fill();
  std::size_t taken = 1;  // the last of fill()
  while (outbox_->send(wire("answer"), Purpose::answer) == Sent::waits) ++taken;
  EXPECT_EQ(taken, limits_.answers);
  EXPECT_EQ(outbox_->send_control("pong"), Sent::waits) << "the protocol's own always go";
}

TEST_F(OutboxTest, WhatWentInPart_IsNotDropped) {
  const std::string sent(40'000, 'p');
  EXPECT_EQ(outbox_->send(wire(sent), Purpose::state), Sent::waits);
  EXPECT_EQ(outbox_->send(wire("gone"), Purpose::state), Sent::waits);
  EXPECT_EQ(outbox_->drop_state(), 1U);
  EXPECT_EQ(read_to_the_end(), sent);
}

TEST_F(OutboxTest, DroppedToNothing_StillSaysWhenItMayBeWritten) {
  // Nothing of the state went: all of it is dropped, and the wait for the socket is still on.
  const auto before = fill(8192);
  while (read().size() == 8192) {
  }
  (void)before;
  while (outbox_->flush() == Outbox::Flushed::some) read();
  ASSERT_TRUE(outbox_->idle());
  while (outbox_->send(wire(std::string(512, 's')), Purpose::state) == Sent::handed) {
  }
  outbox_->drop_state();
  EXPECT_FALSE(outbox_->idle()) << "somebody will call flush()";
  EXPECT_TRUE(outbox_->stalled_since()) << "and until then it stands still";
  read();
  EXPECT_EQ(outbox_->flush(), Outbox::Flushed::all);
  EXPECT_TRUE(outbox_->idle());
}

TEST_F(OutboxTest, Close_SendsTheLastWordBehindWhatWaits) {
  const auto before = fill();
  outbox_->close({1013, "slow"}, wire("last"));
  outbox_->close({1000, "again"}, wire("not heard"));
  EXPECT_EQ(owner_->code, 1013);
  EXPECT_EQ(outbox_->send(wire("state"), Purpose::state), Sent::closed);
  EXPECT_EQ(outbox_->send_control("\x88\x02xx"), Sent::waits) << "the close frame itself";
  EXPECT_EQ(outbox_->send_control("\x8A"), Sent::closed) << "nothing follows a close frame";
  EXPECT_EQ(read_to_the_end(), before + "last" + "\x88\x02xx");
}

TEST_F(OutboxTest, CloseFrameOfBeast_EndsWhatThePeerSends) {
  EXPECT_EQ(outbox_->send_control("\x88\x02xx"), Sent::handed);
  EXPECT_EQ(outbox_->send(wire("state"), Purpose::state), Sent::closed);
  EXPECT_EQ(read(), "\x88\x02xx");
}

TEST_F(OutboxTest, Detached_TouchesNoDescriptor) {
  fill();
  outbox_->detach();
  EXPECT_TRUE(outbox_->detached());
  read();
  // The number may be somebody else's by now: here it is still open, and nothing comes through it.
  EXPECT_EQ(outbox_->send(wire("state"), Purpose::state), Sent::closed);
  EXPECT_EQ(outbox_->send_control("pong"), Sent::closed);
  EXPECT_EQ(outbox_->flush(), Outbox::Flushed::closed);
  outbox_->close({1000, ""}, wire("last"));
  EXPECT_EQ(read(), "");
  EXPECT_EQ(owner_->code, 0);
}

TEST_F(OutboxTest, Finished_IsDetachedAndSaysSo) {
  fill();
  outbox_->finish();
  EXPECT_TRUE(owner_->over);
  EXPECT_TRUE(outbox_->detached());
  EXPECT_EQ(outbox_->send(wire("state"), Purpose::state), Sent::closed);
}

TEST_F(OutboxTest, ClientGone_IsNoticedByWhoeverSends) {
  ::shutdown(ends_[1], SHUT_RDWR);
  EXPECT_EQ(outbox_->send(wire("state"), Purpose::state), Sent::closed);
  EXPECT_EQ(outbox_->send(wire("state"), Purpose::state), Sent::closed);
  char byte = 0;
  EXPECT_EQ(::recv(ends_[0], &byte, 1, MSG_DONTWAIT), 0) << "and the reader finds the end";
}

TEST_F(OutboxTest, WhatHadToWait_CountsItsLateness) {
  const auto lateness = std::make_shared<metrics::LatenessHistogram>(metrics::lateness_bounds);
  http::WireMessage message;
  message.bytes = std::string(40'000, 'l');
  message.due = std::chrono::steady_clock::now() - std::chrono::milliseconds(300);
  message.lateness = lateness;
  EXPECT_EQ(outbox_->send(std::make_shared<const http::WireMessage>(std::move(message)), Purpose::state), Sent::waits);
  EXPECT_EQ(lateness->values().count(), 0U);
  read_to_the_end();
  EXPECT_EQ(lateness->values().count(), 1U);
  EXPECT_GE(lateness->values().sum, 0.3);
}

TEST_F(OutboxTest, ManyThreads_NoMessageIsTornOrReordered) {
  limits_.messages = limits_.answers = 1'000'000;
  outbox_ = std::make_shared<Outbox>(ends_[0], limits_, owner_);
  constexpr int threads = 4;
  constexpr int messages = 2000;
  std::string got;
  std::atomic<int> left{threads};
  std::vector<std::thread> senders;
  for (int t = 0; t < threads; ++t) {
    senders.emplace_back([this, t, &left] {
      for (int i = 0; i < messages; ++i) {
        std::string bytes(12, ' ');
        std::snprintf(bytes.data(), bytes.size(), "<%d:%08d", t, i);
        bytes.back() = '>';
        outbox_->send(wire(bytes), i % 3 == 0 ? Purpose::answer : Purpose::state);
      }
      --left;
    });
  }
  while (left > 0) {
    outbox_->flush();
    got += read();
  }
  for (auto& sender : senders) sender.join();
  got += read_to_the_end();
  ASSERT_EQ(got.size(), static_cast<std::size_t>(threads * messages * 12));
  std::array<int, threads> next{};
  for (std::size_t at = 0; at < got.size(); at += 12) {
    int thread = -1;
    int number = -1;
    ASSERT_EQ(std::sscanf(got.c_str() + at, "<%d:%d", &thread, &number), 2) << got.substr(at, 12);
    ASSERT_EQ(got[at + 11], '>');
    EXPECT_EQ(number, next.at(static_cast<std::size_t>(thread))++);
  }
}

}  // namespace
}  // namespace semblante::net

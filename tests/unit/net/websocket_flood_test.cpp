// Clients that send pings, pongs or fragments without end and never complete a message.

#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "server/net/frame_guard.h"
#include "tests/support/wait.h"
#include "tests/unit/net/raw_client.h"
#include "tests/unit/net/server_fixture.h"

namespace semblante::net {
namespace {

class WebSocketFlood : public ServerFixture {
 protected:
  /// Sends `bytes` and reads until the server ends the connection; what was read.
  [[nodiscard]] std::string flood_with(const std::string& bytes) const {
    const Client bad(port_);
    bad.upgrade();
    std::string all;
    // Together: the server does not read on while its answers wait.
    std::thread reader([&] {
      while (const auto piece = bad.read_piece()) all += *piece;
    });
    static_cast<void>(bad.try_send(bytes));
    reader.join();
    EXPECT_TRUE(testing::eventually([&] { return application_.peers == 0; }));
    return all;
  }
  /// The close frame of these words is the last of `all`.
  static void expect_closed_with(std::string_view words, const std::string& all) {
    EXPECT_TRUE(all.ends_with("\x03\xF0" + std::string(words))) << all.size() << " bytes";
  }

  const ServerLimits limits_{};
};

std::string repeated(const std::string& frames, double count) {
  std::string all;
  for (int i = 0; i < static_cast<int>(count); ++i) all += frames;
  return all;
}

TEST_F(WebSocketFlood, Controls_AreClosed_AndNotReadAnyFurther) {
  for (const char opcode : {'\x89', '\x8A'}) {  // pings, pongs
    // Sent in far less time than the rate gives back as many.
    const auto all = flood_with(repeated(Client::frame(opcode, ""), limits_.controls_burst * 20));
    expect_closed_with("sends too many pings", all);
    EXPECT_LT(all.size(), static_cast<std::size_t>(limits_.controls_burst) * 5) << "two bytes for each pong";
  }
}

TEST_F(WebSocketFlood, ControlsWithinTheBurst_AreAnswered) {
  const Client good(port_);
  good.upgrade();
  for (int i = 0; i < limits_.controls_burst / 2; ++i) good.send(Client::frame('\x89', "p"));
  for (int i = 0; i < limits_.controls_burst / 2; ++i) ASSERT_EQ(good.read(3), "\x8A\x01p") << i;
}

TEST_F(WebSocketFlood, FragmentsOfOneMessage_AreClosed) {
  const auto begin = Client::frame('\x01', "");
  for (const std::string& fragment : {Client::frame('\0', ""), Client::frame('\0', "x"),
                                      Client::frame('\0', "") + Client::frame('\x8A', "") + Client::frame('\0', "")})
    expect_closed_with("sends a message in too many fragments",
                       flood_with(begin + repeated(fragment, limits_.max_fragments)));
}

TEST_F(WebSocketFlood, FragmentsOfManyMessages_AreClosed) {
  const auto message = Client::frame('\x01', "") + repeated(Client::frame('\0', ""), 500) + Client::frame('\x80', "");
  const auto all = flood_with(repeated(message, limits_.fragments_burst / 500 * 20));
  expect_closed_with("sends too many fragments of messages", all);
}

/// RFC 6455 section 5.4 permits empty fragments, and control frames between fragments.
TEST_F(WebSocketFlood, MessageInOddPieces_IsOneMessage) {
  const Client client(port_);
  client.upgrade();
  std::string pieces = Client::frame('\x01', "");
  pieces += repeated(Client::frame('\0', ""), limits_.max_fragments - 3);
  pieces += Client::frame('\0', "he") + Client::frame('\x89', "p") + Client::frame('\0', "llo");
  client.send(pieces + Client::frame('\x80', ""));
  EXPECT_EQ(client.read(10),
            "\x8A\x01p"
            "\x81\x05hello");
}

TEST_F(WebSocketFlood, ReadsNothingMore_OfAClientThatNeverReads) {
  const Client deaf(port_), good(port_);
  deaf.upgrade();
  good.upgrade();
  // More than the sockets' buffers hold, unless the server reads it.
  const auto fragments = Client::frame('\x01', "") + repeated(Client::frame('\0', ""), 64'000'000 / 6);
  EXPECT_FALSE(deaf.try_send(fragments));
  good.say("hello");
  EXPECT_EQ(good.read(7), "\x81\x05hello");
  EXPECT_TRUE(testing::eventually([&] { return application_.peers == 1; }));
}

TEST(FrameGuard, CountsFrames_HoweverTheBytesArrive) {
  ServerLimits limits;
  limits.max_fragments = 3;
  const auto long_frame = [](char first, char length, std::size_t bytes_of_length, std::size_t size) {
    std::string frame{first, length};
    for (std::size_t i = bytes_of_length; i-- > 0;) frame += static_cast<char>((size >> (8 * i)) & 0xFFU);
    return frame + "mask" + std::string(size, '\0');  // a payload that would be fragments
  };
  const std::string message = Client::frame('\x02', "\x01\x01") + long_frame('\0', '\xFE', 2, 300) +
                              Client::frame('\x8A', "pong") + long_frame('\0', '\xFF', 8, 70'000) +
                              std::string("\x80\x02zz", 4);  // the last one without a mask: Beast refuses it
  for (const std::size_t piece : {std::size_t{1}, std::size_t{7}, std::size_t{4096}, 4 * message.size()}) {
    SCOPED_TRACE(piece);
    FrameGuard guard(limits);
    const auto all = message + message + Client::frame('\x01', "") + repeated(Client::frame('\0', ""), 2);
    for (std::size_t at = 0; at < all.size(); at += piece)
      EXPECT_EQ(guard.look(std::string_view(all).substr(at, piece)), std::nullopt);
    const auto fault = guard.look(Client::frame('\0', ""));
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->words, "sends a message in too many fragments");
  }
}

TEST(FrameGuard, FindsCodesThatThereAreNot_HoweverTheBytesArrive) {
  const ServerLimits limits;
  const auto fault_of = [&](const std::string& bytes, std::size_t piece) {
    FrameGuard guard(limits);
    std::optional<FrameGuard::Fault> fault;
    for (std::size_t at = 0; at < bytes.size() && !fault; at += piece)
      fault = guard.look(std::string_view(bytes).substr(at, piece));
    return fault ? fault->code : 0;
  };
  const auto text = Client::frame('\x81', "\x17\x70"), ping = Client::frame('\x89', "\x17\x70");
  for (const std::size_t piece : {std::size_t{1}, std::size_t{3}, std::size_t{4096}}) {
    SCOPED_TRACE(piece);
    EXPECT_EQ(fault_of(text + Client::frame('\x88', "\x17\x70why"), piece), FrameGuard::protocol_error);
    EXPECT_EQ(fault_of(Client::frame('\x88', "\x13\x88"), piece), FrameGuard::protocol_error) << 5000;
    EXPECT_EQ(fault_of(text + ping + Client::frame('\x88', "\x13\x87"), piece), 0) << 4999;
    EXPECT_EQ(fault_of(Client::frame('\x88', ""), piece), 0);
  }
}

TEST(FrameGuard, FindsReasonsThatAreNotUtf8_HoweverTheBytesArrive) {
  const ServerLimits limits;
  const auto fault_of = [&](const std::string& bytes, std::size_t piece) {
    FrameGuard guard(limits);
    std::optional<FrameGuard::Fault> fault;
    for (std::size_t at = 0; at < bytes.size() && !fault; at += piece)
      fault = guard.look(std::string_view(bytes).substr(at, piece));
    return fault ? fault->code : 0;
  };
  const auto close = [](const std::string& reason) { return Client::frame('\x88', "\x03\xE8" + reason); };
  for (const std::size_t piece : {std::size_t{1}, std::size_t{3}, std::size_t{4096}}) {
    SCOPED_TRACE(piece);
    EXPECT_EQ(fault_of(close("caf\xC3\xA9"), piece), 0);
    EXPECT_EQ(fault_of(close(std::string(123, 'x')), piece), 0);
    EXPECT_EQ(fault_of(close("caf\xE9"), piece), FrameGuard::invalid_payload);
    EXPECT_EQ(fault_of(close("caf\xC3"), piece), FrameGuard::invalid_payload) << "half a character";
    EXPECT_EQ(fault_of(close(std::string(122, 'x') + "\xFF"), piece), FrameGuard::invalid_payload);
    EXPECT_EQ(fault_of(Client::frame('\x89', "\x03\xE8\xFF"), piece), 0) << "a ping";
  }
}

TEST_F(WebSocketFlood, ReasonThatIsNotUtf8_IsAnsweredWithInvalidPayload) {
  const auto all = flood_with(Client::frame('\x88', "\x03\xE8\xFF"));
  EXPECT_TRUE(
      all.ends_with("\x03\xEF"
                    "closes with a reason that is not UTF-8"))
      << all;
}

TEST_F(WebSocketFlood, CodeThatThereIsNot_IsAnsweredWithAProtocolError) {
  const auto all = flood_with(Client::frame('\x88', "\x17\x70"));  // 6000
  EXPECT_TRUE(
      all.ends_with("\x03\xEA"
                    "closes with a code that there is not"))
      << all;
  EXPECT_TRUE(flood_with(Client::frame('\x88', "\x13\x87")).ends_with("\x13\x87")) << "4999 is anybody's";
}

TEST(FrameGuard, EndsAMessage_ThatArrivesTooSlowly) {
  using std::chrono::seconds;
  const ServerLimits limits;
  const auto grace = limits.body_grace;
  const std::string big = std::string("\x81\xFE\xEA\x60", 4) + std::string(4 + 60'000, 'x');
  const auto half = std::string_view(big).substr(0, big.size() / 2), rest = std::string_view(big).substr(half.size());
  const auto slow = [&](const std::vector<std::pair<seconds, std::string>>& pieces) {
    FrameGuard guard(limits);
    std::optional<FrameGuard::Fault> fault;
    const auto begin = FrameGuard::Clock::now();
    for (const auto& [after, bytes] : pieces) {
      EXPECT_EQ(fault, std::nullopt) << "before the last piece";
      fault = guard.look(bytes, begin + after);
    }
    return fault && fault->words == "sends a message too slowly";
  };
  const auto text = Client::frame('\x81', "hello"), ping = Client::frame('\x89', "p");
  const auto part = Client::frame('\x01', "a"), more = Client::frame('\0', "b");
  const auto late = grace + seconds(1);
  EXPECT_TRUE(slow({{seconds(0), text.substr(0, 1)}, {late, text.substr(1, 1)}})) << "a header";
  EXPECT_TRUE(slow({{seconds(0), text.substr(0, 8)}, {grace, text.substr(8, 1)}, {late, text.substr(9, 1)}}));
  EXPECT_TRUE(slow({{seconds(0), ping.substr(0, 1)}, {late, ping.substr(1, 1)}})) << "a ping";
  EXPECT_TRUE(slow({{seconds(0), part}, {grace, ping}, {late, more}})) << "pings are no progress of a message";
  EXPECT_TRUE(slow({{seconds(0), part}, {late, ping}}));
  EXPECT_FALSE(slow({{seconds(0), text}, {late, text}, {10 * late, ping}, {20 * late, ping + part}}));
  EXPECT_FALSE(slow({{seconds(0), text + part}, {grace, more + Client::frame('\x80', "")}, {3 * late, text}}));
  // At the least rate, as a body.
  const seconds of_half(half.size() / limits.least_body_rate);
  EXPECT_FALSE(slow({{seconds(0), std::string(half)}, {grace + of_half, std::string(rest.substr(0, 1))}}));
  EXPECT_TRUE(slow({{seconds(0), std::string(half)}, {grace + of_half + seconds(2), std::string(rest.substr(0, 1))}}));
}

}  // namespace
}  // namespace semblante::net

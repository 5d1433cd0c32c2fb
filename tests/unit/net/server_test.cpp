// The server under an application of three lines, spoken to byte by byte.

#include "server/net/server.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <latch>
#include <memory>
#include <poll.h>
#include <stdexcept>
#include <thread>
#include <unistd.h>
#include <vector>

#include <arpa/inet.h>
#include <boost/asio/post.hpp>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include "server/net/worker_pool.h"
#include "tests/support/wait.h"
#include "tests/unit/net/echo_application.h"
#include "tests/unit/net/raw_client.h"
#include "tests/unit/net/server_fixture.h"

namespace semblante::net {
namespace {

using namespace std::chrono_literals;

class ServerTest : public ServerFixture {};

TEST_F(ServerTest, WebSocket_SaysBack) {
  const Client client(port_);
  client.upgrade();
  client.say("hello");
  EXPECT_EQ(client.read(7), "\x81\x05hello");
  client.send(Client::frame('\x89', "p"));
  client.say("again");
  EXPECT_EQ(client.read(10),
            "\x8A\x01p\x81\x05"
            "again");
  client.send(Client::frame('\x88', "\x03\xE8"));
  EXPECT_EQ(client.read(4), "\x88\x02\x03\xE8");
  EXPECT_EQ(client.read(1), "") << "and its side of the connection";
}

TEST_F(ServerTest, RequestsAndHandshakes_GiveWayToWebSockets) {
  const int own = rank_of_this_thread();
  const Client client(port_);
  for (const char* path : {"/rank", "/immediate/rank"}) {
    client.send(get(path));
    const auto head = client.read_head();
    const auto length = std::stoul(head.substr(head.find("Content-Length: ") + 16));
    EXPECT_EQ(client.read(length), std::to_string(std::min(own + 10, 19))) << path;
  }
  const Client socket(port_);
  socket.upgrade();
  socket.say("rank");
  const auto rank = std::to_string(own);
  EXPECT_EQ(socket.read(2 + rank.size()).substr(2), rank);
}

TEST_F(ServerTest, WebSocket_WantsAKeyOf16Bytes_AndDoesNotNameItsLibrary) {
  const std::string request(Client::upgrade_request);
  const std::string key = "dGhlIHNhbXBsZSBub25jZQ==";
  for (const char* wrong : {"dGhlIHNhbXBsZSBub25jZQ=", "dGhlIHNhbXBsZSBub25jZQAA", "%%%%%%%%%%%%%%%%%%%%%%%%",
                            "dGhlIHNhbXBsZSB\xC3\xA9"
                            "b25jZ==",
                            "=========================", ""}) {
    SCOPED_TRACE(wrong);
    const Client client(port_);
    auto head = request;
    client.send(head.replace(head.find(key), key.size(), wrong));
    EXPECT_TRUE(client.read_head().starts_with("HTTP/1.1 400 "));
  }
  EXPECT_EQ(application_.opened, 0);
  const Client client(port_);
  client.send(request);
  const auto head = client.read_head();
  EXPECT_TRUE(head.starts_with("HTTP/1.1 101 "));
  EXPECT_EQ(head.find("Beast"), std::string::npos) << head;
}

TEST_F(ServerTest, BytesBehindTheUpgrade_LeaveNoPeerBehind) {
  const Client client(port_);
  client.send(std::string(Client::upgrade_request) + Client::frame('\x81', "hello"));
  EXPECT_TRUE(client.read_head().starts_with("HTTP/1.1 400 "));
  EXPECT_TRUE(testing::eventually([&] { return application_.peers == 0; }))
      << "it holds its place in a stream for ever";
}

TEST_F(ServerTest, AfterTheClosingHandshake_NobodyWaitsForTheSocket) {
  // Both have said that it is over, but this client never closes its socket.
  const Client theirs(port_);
  theirs.upgrade();
  theirs.send(Client::frame('\x88', "\x03\xE8"));
  EXPECT_EQ(theirs.read(4), "\x88\x02\x03\xE8");
  const Client ours(port_);
  ours.upgrade();
  ours.say("bye");
  EXPECT_EQ(ours.read(7),
            "\x88\x05\x03\xE8"
            "bye");
  ours.send(Client::frame('\x88', "\x03\xE8"));
  EXPECT_TRUE(testing::eventually([&] { return application_.peers == 0; }));
  EXPECT_EQ(server_->counts().websockets_open, 0U);
  EXPECT_EQ(server_->counts().connections_open, 2U);
}

TEST_F(ServerTest, FaultOfAPeer_EndsItsConnectionAlone) {
  const Client good(port_);
  good.upgrade();
  const Client bad(port_);
  bad.upgrade();
  bad.say("throw");
  EXPECT_EQ(bad.read(1), "") << "cut off";
  EXPECT_TRUE(testing::eventually([&] { return application_.peers == 1; }));
  good.say("hello");
  EXPECT_EQ(good.read(7), "\x81\x05hello");
  const Client next(port_);
  next.upgrade();
}

TEST_F(ServerTest, ImmediateRoute_AnswersWhileEveryWorkerIsBusy) {
  std::vector<std::unique_ptr<Client>> slow;
  for (int i = 0; i < workers; ++i) slow.emplace_back(std::make_unique<Client>(port_))->send(get("/slow"));
  ASSERT_TRUE(testing::eventually([&] { return application_.waiting == workers; }));
  const Client client(port_);
  client.send(get("/immediate"));
  EXPECT_TRUE(client.read_head().starts_with("HTTP/1.1 200 "));
  client.send("HEAD /immediate HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_TRUE(client.read_head().starts_with("HTTP/1.1 200 ")) << "the connection goes on";
  application_.released.count_down();
  for (const auto& one : slow) EXPECT_TRUE(one->read_head().starts_with("HTTP/1.1 200 "));
}

TEST_F(ServerTest, FaultsOfTheApplication_AreAnswers) {
  const Client client(port_);
  for (const char* path : {"/throw", "/bad-plan", "/throw"}) {
    SCOPED_TRACE(path);
    const Client one(port_);
    one.send(get(path));
    EXPECT_TRUE(one.read_head().starts_with("HTTP/1.1 500 "));
  }
  client.send(get("/"));
  EXPECT_TRUE(client.read_head().starts_with("HTTP/1.1 200 "));
}

TEST_F(ServerTest, ChunkedBody_ByteByByte_IsTaken) {
  const Client client(port_);
  for (const char c :
       std::string_view("GET /immediate HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n"
                        "2;e=f\r\nhi\r\n0\r\nX: y\r\n\r\n"))
    client.send({&c, 1});
  EXPECT_TRUE(client.read_head().starts_with("HTTP/1.1 200 "));
  EXPECT_EQ(client.read(2), "hi");
  // No body at all, the last chunk in pieces: Beast asserts on fewer bytes of it than five.
  client.send("GET /immediate HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n");
  for (const char c : std::string_view("0\r\n\r\n")) {
    client.send({&c, 1});
    std::this_thread::sleep_for(5ms);  // so that it is read alone; passes also when it is not
  }
  EXPECT_TRUE(client.read_head().starts_with("HTTP/1.1 200 "));
}

TEST_F(ServerTest, ChunksOfLittleContentAndMuchFraming_AreRefused) {
  const std::string head = "GET /immediate HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n";
  const auto chunks = [](const std::string& chunk, int count) {
    std::string all;
    for (int i = 0; i < count; ++i) all += chunk;
    return all;
  };
  const std::string zeros(2000, '0');
  for (const std::string& body : {chunks(zeros + "1\r\nx\r\n", 10), chunks("1;" + zeros + "\r\nx\r\n", 10),
                                  zeros + chunks(zeros, 10) + "1\r\n"}) {
    const Client client(port_);
    static_cast<void>(client.try_send(head + body));
    EXPECT_TRUE(client.read_head().starts_with("HTTP/1.1 400 "));
  }
  const Client honest(port_);
  honest.send(head + chunks("1\r\nx\r\n", 100) + "0\r\n\r\n");
  EXPECT_TRUE(honest.read_head().starts_with("HTTP/1.1 200 "));
  EXPECT_EQ(honest.read(100), std::string(100, 'x'));
}

TEST_F(ServerTest, UnendingTrailers_EndTheirConnectionAlone) {
  const Client good(port_);
  good.upgrade();
  {
    const Client bad(port_);
    bad.send("GET / HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n0\r\nX: " +
             std::string(66'000, 'a') + "\r\n\r\n");
    EXPECT_TRUE(bad.read_head().starts_with("HTTP/1.1 431 "));
  }
  good.say("hello");
  EXPECT_EQ(good.read(7), "\x81\x05hello");
}

TEST_F(ServerTest, HeadersThatAProxyCouldReadOtherwise_AreRefused) {
  const std::string begin = "GET /immediate HTTP/1.1\r\n";
  const std::string host = "Host: localhost\r\n";
  const std::string chunked = "Transfer-Encoding: chunked\r\n";
  for (const std::string& head : {begin,
                                  begin + host + host,
                                  begin + host + "Host: other.example\r\n",
                                  begin + host + "Transfer-Encoding: xchunked\r\n",
                                  begin + host + "Transfer-Encoding: gzip\r\n",
                                  begin + host + "Transfer-Encoding: identity\r\nContent-Length: 2\r\n",
                                  begin + host + "Transfer-Encoding: chunked, gzip\r\n",
                                  begin + host + "Transfer-Encoding: gzip, chunked\r\n",
                                  begin + host + chunked + chunked,
                                  begin + host + chunked + "Content-Length: 2\r\n",
                                  begin + host + "Content-Length: 2\r\n" + chunked,
                                  begin + host + "Content-Length: 2\r\nContent-Length: 2\r\n",
                                  begin + host + "Content-Length: 2, 2\r\n",
                                  begin + host + "Content-Length: +2\r\n",
                                  "GET /immediate HTTP/1.0\r\n" + chunked,
                                  begin + host + "X: a\r\n b\r\n",
                                  begin + host + "X: a\r\n\tb\r\n",
                                  begin + host + "X:\r\n a\r\n",
                                  begin + host + "X: a\r\n \r\n",
                                  begin + "Host:\r\n localhost\r\n",
                                  begin + " X: a\r\n" + host,
                                  begin + host + "X : a\r\n"}) {
    SCOPED_TRACE(head);
    const Client client(port_);
    client.send(head + "\r\n");
    EXPECT_TRUE(client.read_head().starts_with("HTTP/1.1 400 "));
  }
  const Client old(port_);
  old.send("GET /immediate HTTP/1.0\r\n\r\n");
  EXPECT_TRUE(old.read_head().starts_with("HTTP/1.0 200 ")) << "HTTP/1.0 needs no Host";
}

TEST_F(ServerTest, EmptyLineBeforeARequest_IsIgnored) {
  const Client client(port_);
  client.send("\r\n" + get("/immediate"));
  EXPECT_TRUE(client.read_head().starts_with("HTTP/1.1 200 "));
  const std::string post = "POST /immediate HTTP/1.1\r\nHost: localhost\r\nContent-Length: 2\r\n\r\nhi\r\n";
  for (int i = 0; i < 3; ++i) {
    client.send(post);  // with a line behind its body, which does not count
    EXPECT_TRUE(client.read_head().starts_with("HTTP/1.1 200 "));
    EXPECT_EQ(client.read(2), "hi");
  }
  client.send("\r\n" + get("/immediate"));
  EXPECT_TRUE(client.read_head().starts_with("HTTP/1.1 400 ")) << "two are none";
}

TEST_F(ServerTest, ContinueIsNotSaidToHttp10) {
  const Client client(port_);
  client.send("POST /immediate HTTP/1.0\r\nContent-Length: 2\r\nExpect: 100-continue\r\n\r\nhi");
  EXPECT_TRUE(client.read_head().starts_with("HTTP/1.0 200 "));
}

TEST_F(ServerTest, AnotherExpectationThanContinue_IsNotMet) {
  const Client client(port_);
  client.send("POST /immediate HTTP/1.1\r\nHost: localhost\r\nContent-Length: 2\r\nExpect: x\r\n\r\n");
  EXPECT_TRUE(client.read_head().starts_with("HTTP/1.1 417 Expectation Failed\r\n"));
}

TEST_F(ServerTest, RefusedHead_HasNoBody) {
  const Client client(port_);
  client.send("HEAD /a%zz HTTP/1.1\r\nHost: localhost\r\n\r\n");
  const auto head = client.read_head();
  EXPECT_TRUE(head.starts_with("HTTP/1.1 400 "));
  EXPECT_EQ(head.find("Content-Length: 0"), std::string::npos);
  EXPECT_EQ(client.read(1), "");
}

TEST_F(ServerTest, TrailerThatGoesOnInAFurtherLine_IsRefused) {
  const Client client(port_);
  client.send(
      "GET /immediate HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n0\r\nX: a\r\n b\r\n\r\n");
  const auto head = client.read_head();
  EXPECT_TRUE(head.starts_with("HTTP/1.1 400 "));
  const auto length = std::stoul(head.substr(head.find("Content-Length: ") + 16));
  EXPECT_NE(client.read(length).find("a header field goes on in a further line"), std::string::npos);
}

TEST_F(ServerTest, TargetThatCannotBeRead_IsAnsweredWithWhatCanBeWrong) {
  for (const auto& [target, words] : {std::pair{"/a b", "has a space that is not %20"},
                                      {"/ HTTP/1.1\nX:", "does not end with CR LF"},
                                      {"/a?b=%zz", "a % without two hexadecimal digits"},
                                      {"/a%2Fb", "an encoded slash"},
                                      {"/a%00", "a zero byte"},
                                      {"ftp://localhost/", "is not a path"}}) {
    SCOPED_TRACE(target);
    const Client client(port_);
    client.send(get(target));
    const auto head = client.read_head();
    const auto length = std::stoul(head.substr(head.find("Content-Length: ") + 16));
    EXPECT_NE(client.read(length).find(words), std::string::npos);
  }
}

TEST_F(ServerTest, ControlCharacterInAChunkExtension_IsRefused) {
  // Some proxies end the line at the line feed, and see another body than the server.
  const std::string head = "GET /immediate HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n";
  for (const char* body : {"1;a=\"\n\"\r\nx\r\n0\r\n\r\n", "1;a=\"\x7f\"\r\nx\r\n0\r\n\r\n", "0;a=\"\n\"\r\n\r\n"}) {
    SCOPED_TRACE(body);
    const Client client(port_);
    client.send(head + body);
    const auto answer = client.read_head();
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 400 "));
    const auto length = std::stoul(answer.substr(answer.find("Content-Length: ") + 16));
    EXPECT_NE(client.read(length).find("a chunk extension has a control character"), std::string::npos);
  }
  const Client quoted(port_);
  quoted.send(head + "1;a=\"b\tc\"\r\nx\r\n0\r\n\r\n");
  EXPECT_TRUE(quoted.read_head().starts_with("HTTP/1.1 200 "));
}

TEST_F(ServerTest, FileThatCannotBeOpened_IsAnswered503_AndTheConnectionStays) {
  application_.file = "/absent/file";
  application_.file_bytes = 5;
  const Client client(port_);
  for (int round = 0; round < 2; ++round) {
    client.send(get("/file"));
    const auto head = client.read_head();
    EXPECT_TRUE(head.starts_with("HTTP/1.1 503 ")) << head;
    EXPECT_NE(head.find("Retry-After: "), std::string::npos);
    EXPECT_NE(head.find("application/problem+json"), std::string::npos);
    EXPECT_NE(head.find("X-Frame-Options: DENY"), std::string::npos) << "what is said of every answer";
    EXPECT_EQ(head.find("ETag"), std::string::npos) << "what is said of the file";
    const auto length = std::stoul(head.substr(head.find("Content-Length: ") + 16));
    EXPECT_NE(client.read(length).find("storage-unavailable"), std::string::npos);
  }
}

TEST_F(ServerTest, OpenFile_IsSent_WhenItsNameIsGone) {
  std::string name = (std::filesystem::temp_directory_path() / "semblante-net-XXXXXX").string();
  const int file = ::mkstemp(name.data());
  ASSERT_EQ(::write(file, "hello", 5), 5);
  ::close(file);
  application_.file = name;
  application_.file_bytes = 5;
  const Client client(port_);
  client.send(get("/removed"));
  EXPECT_TRUE(client.read_head().starts_with("HTTP/1.1 200 "));
  EXPECT_EQ(client.read(5), "hello");
  EXPECT_FALSE(std::filesystem::exists(name));
}

/// Each download has a descriptor beside its connection's. Beyond their limit one is told so, before its header.
TEST_F(ServerTest, FilesInTransfer_HaveALimit) {
  std::string name = (std::filesystem::temp_directory_path() / "semblante-net-XXXXXX").string();
  const int file = ::mkstemp(name.data());
  application_.file = name;
  application_.file_bytes = std::uint64_t{64} << 20U;  // more than sockets hold
  ASSERT_EQ(::ftruncate(file, static_cast<off_t>(application_.file_bytes)), 0);
  ::close(file);
  const Client next(port_);
  {
    std::vector<std::unique_ptr<Client>> readers;
    for (std::uint32_t i = 0; i < max_files; ++i) {
      readers.push_back(std::make_unique<Client>(port_));
      readers.back()->send(get("/file"));
      EXPECT_TRUE(readers.back()->read_head().starts_with("HTTP/1.1 200 "));
    }
    next.send(get("/file"));
    const auto head = next.read_head();
    EXPECT_TRUE(head.starts_with("HTTP/1.1 503 ")) << head;
    const auto length = std::stoul(head.substr(head.find("Content-Length: ") + 16));
    EXPECT_NE(next.read(length).find("overloaded"), std::string::npos);
    const Client other(port_);
    other.send("POST /upload HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1\r\n\r\nx");
    EXPECT_TRUE(other.read_head().starts_with("HTTP/1.1 503 "));
    const Client third(port_);
    third.send(get("/"));
    EXPECT_TRUE(third.read_head().starts_with("HTTP/1.1 200 ")) << "what needs no file is answered";
  }
  EXPECT_TRUE(testing::eventually([&] {
    const Client again(port_);
    again.send(get("/file"));
    return again.read_head().starts_with("HTTP/1.1 200 ");
  })) << "readers that are gone give their places back";
  std::filesystem::remove(name);
}

/// Only the least rate can end a connection here: every other time limit is longer than a test waits.
class LeastRate : public ::testing::Test {
 protected:
  LeastRate() {
    std::string name = (std::filesystem::temp_directory_path() / "semblante-net-XXXXXX").string();
    const int file = ::mkstemp(name.data());
    application_.file = name;
    application_.file_bytes = std::uint64_t{64} << 20U;  // more than sockets hold
    EXPECT_EQ(::ftruncate(file, static_cast<off_t>(application_.file_bytes)), 0);
    ::close(file);
  }
  ~LeastRate() override {
    if (!server_) return;
    server_->stop();
    thread_.join();
    std::filesystem::remove(application_.file);
  }

  void serve(std::uint32_t bytes_per_second) {
    ServerConfig config;
    config.listeners.front().port = 0;
    config.upload_directory = std::filesystem::temp_directory_path();
    auto& limits = config.limits;
    limits.idle_timeout = limits.header_timeout = limits.read_timeout = limits.write_timeout = 10 * testing::patience;
    limits.body_grace = grace;
    limits.least_body_rate = bytes_per_second;
    server_ = std::make_unique<Server>(config, application_);
    port_ = server_->listen().value().front();
    thread_ = std::thread([this] { server_->run([] {}); });
  }
  [[nodiscard]] bool is_alone() const { return server_->counts().connections_open == 0; }

  static constexpr std::chrono::seconds grace{1};
  EchoApplication application_;
  std::unique_ptr<Server> server_;
  std::uint16_t port_ = 0;
  std::thread thread_;
};

TEST_F(LeastRate, SlowMessage_OfAWebSocket_IsCutOff) {
  serve(1'000'000);
  const Client client(port_);
  client.upgrade();
  client.send(std::string("\x81\xFE\xFF\xFFmask", 8));
  // As for a body.
  ASSERT_TRUE(testing::eventually([&] { return is_alone() || !client.try_send("x"); }, 100ms));
  EXPECT_TRUE(testing::eventually([&] { return is_alone(); }));
  EXPECT_TRUE(client.read(100).ends_with("\x03\xF0sends a message too slowly"));
}

TEST_F(LeastRate, SlowBody_IsCutOff) {
  serve(1'000'000);
  const Client client(port_);
  const auto begin = std::chrono::steady_clock::now();
  client.send("POST /upload HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000000\r\n\r\n");
  ASSERT_TRUE(testing::eventually([&] { return !is_alone(); })) << "the server has not accepted the connection yet";
  // A piece is never late, however busy the machine is; all pieces of the test together are less than the rate wants.
  ASSERT_TRUE(testing::eventually([&] { return is_alone() || !client.try_send("x"); }, 100ms));
  EXPECT_TRUE(testing::eventually([&] { return is_alone(); }));
  EXPECT_GE(std::chrono::steady_clock::now() - begin, grace) << "not at once";
}

TEST_F(LeastRate, SlowReaderOfAFile_IsCutOff) {
  constexpr std::uint32_t rate = 1'000'000;
  serve(rate);
  const Client slow(port_);
  slow.send(get("/file"));
  EXPECT_TRUE(slow.read_head().starts_with("HTTP/1.1 200 "));
  const auto begin = std::chrono::steady_clock::now();
  std::uint64_t got = 0;
  // The client reads at no more than a quarter of the least rate: enough that no single write of the server waits for
  // long, so that only the rate can end the connection.
  EXPECT_TRUE(testing::eventually(
      [&] {
        const std::chrono::duration<double> past = std::chrono::steady_clock::now() - begin;
        if (static_cast<double>(got) < past.count() * rate / 4) got += slow.read_some();
        return is_alone() || got == application_.file_bytes;
      },
      10ms));
  EXPECT_LT(got, application_.file_bytes);
}

TEST_F(LeastRate, ReaderThatPausesButIsFasterThanTheRate_GetsTheWholeFile) {
  serve(1000);
  const Client quick(port_);
  quick.send(get("/file"));
  EXPECT_TRUE(quick.read_head().starts_with("HTTP/1.1 200 "));
  // Longer than the grace. The pieces that the sockets hold by now, 64 KiB at least, are a minute at this rate.
  std::this_thread::sleep_for(grace + 500ms);
  std::uint64_t got = 0;
  while (const auto more = quick.read_some()) {
    got += more;
    if (got == application_.file_bytes) break;
  }
  EXPECT_EQ(got, application_.file_bytes);
}

TEST(WorkerPool, SurvivesWhatThrows) {
  WorkerPool pool(2);
  std::atomic<int> done{0};
  for (int i = 0; i < 20; ++i) {
    boost::asio::post(pool.executor(), [&done, i] {
      ++done;
      if (i % 2 == 0) throw std::runtime_error("a fault of ours");
    });
  }
  pool.join();
  EXPECT_EQ(done, 20);
}

}  // namespace
}  // namespace semblante::net

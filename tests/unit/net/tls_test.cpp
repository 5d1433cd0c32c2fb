// The server with TLS: the same application as in server_test.cpp, spoken to by OpenSSL's client.

#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>
#include <unistd.h>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <openssl/tls1.h>
#include <sys/socket.h>

#include "server/net/self_signed.h"
#include "server/net/server.h"
#include "server/net/tls_context.h"
#include "tests/support/tls_client.h"
#include "tests/support/wait.h"
#include "tests/unit/net/echo_application.h"

namespace semblante::net {
namespace {

using semblante::testing::TlsClient;

constexpr std::string_view upgrading =
    "GET /echo HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
    "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";

std::string asking_for(std::string_view path) {
  return "GET " + std::string(path) + " HTTP/1.1\r\nHost: localhost\r\n\r\n";
}

/// One text message in one frame of up to 65535 bytes; the mask of zeros leaves it as it is.
std::string text_frame(std::string_view payload) {
  constexpr std::size_t longest_short = 125;
  std::string bytes{'\x81'};
  if (payload.size() <= longest_short) {
    bytes += static_cast<char>(0x80U | payload.size());
  } else {
    bytes += '\xFE';
    bytes += static_cast<char>(payload.size() >> 8U);
    bytes += static_cast<char>(payload.size());
  }
  return bytes.append(4, '\0').append(payload);
}

/// A self-signed certificate of this common name, for localhost.
TlsFiles certificate_in(const std::filesystem::path& folder, const std::string& common_name) {
  const TlsFiles files{folder / "certificate.pem", folder / "key.pem"};
  EXPECT_TRUE(write_self_signed(files, common_name, {"localhost", "127.0.0.1"}, std::chrono::hours(1)));
  return files;
}

class TlsTest : public ::testing::Test {
 protected:
  TlsTest() {
    std::signal(SIGPIPE, SIG_IGN);
    std::filesystem::create_directories(folder_);
    files_ = certificate_in(folder_, "first");
    ServerConfig config;
    config.listeners = {{"127.0.0.1", 0, true}, {"127.0.0.1", 0, false}};
    config.limits.header_timeout = config.limits.idle_timeout = config.limits.drain_time =
        10 * semblante::testing::patience;
    server_ = std::make_unique<Server>(config, application_);
    const auto ports = server_->listen().value();
    port_ = ports[0];
    plain_port_ = ports[1];
    server_->set_tls(TlsContext::load(files_).value());
    thread_ = std::thread([this] { server_->run([] {}); });
  }
  ~TlsTest() override {
    EXPECT_TRUE(semblante::testing::eventually([&] { return server_->counts().connections_open == 0; }));
    server_->stop();
    thread_.join();
    std::filesystem::remove_all(folder_);
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("semblante-tls-" + std::to_string(::getpid()));
  TlsFiles files_;
  EchoApplication application_;
  std::unique_ptr<Server> server_;
  std::uint16_t port_ = 0, plain_port_ = 0;
  std::thread thread_;
};

TEST_F(TlsTest, Requests_AreAnsweredInBothVersions) {
  for (const int version : {TLS1_2_VERSION, TLS1_3_VERSION}) {
    TlsClient client(port_, version, version);
    ASSERT_TRUE(client.connected());
    for (int i = 0; i < 3; ++i) {
      ASSERT_TRUE(client.send("POST /immediate HTTP/1.1\r\nHost: localhost\r\nContent-Length: 2\r\n\r\nhi"));
      EXPECT_TRUE(client.read_head().starts_with("HTTP/1.1 200 ")) << client.version();
      EXPECT_EQ(client.read(2), "hi");
    }
  }
}

TEST_F(TlsTest, Handshakes_AreOfAThreadThatGivesWayToAllOthers) {
  constexpr int lowest = 19, of_requests = 10;  // steps of nice
  const int own = rank_of_this_thread();
  if (own + of_requests >= lowest) GTEST_SKIP() << "there is no room between the ranks";
  // Nanoseconds of the processor that the threads of a rank have had.
  const auto time_of = [](int rank) {
    double time = 0.0;
    for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task")) {
      const auto id = static_cast<id_t>(std::stoul(thread.path().filename().string()));
      if (::getpriority(PRIO_PROCESS, id) != rank) continue;
      double had = 0.0;
      std::ifstream(thread.path() / "schedstat") >> had;
      time += had;
    }
    return time;
  };
  if (time_of(own) == 0.0) GTEST_SKIP() << "the kernel does not tell the time of threads";
  const double handshakes = time_of(lowest), requests = time_of(own + of_requests);
  constexpr int number = 50;
  for (int i = 0; i < number; ++i) EXPECT_TRUE(TlsClient(port_).connected());
  EXPECT_GT(time_of(lowest) - handshakes, time_of(own + of_requests) - requests);
}

TEST_F(TlsTest, OldVersions_AreRefused) {
  EXPECT_FALSE(TlsClient(port_, TLS1_VERSION, TLS1_1_VERSION).connected());
  EXPECT_TRUE(TlsClient(port_).connected()) << "the others go on";
}

TEST_F(TlsTest, PlainBytes_EndTheirConnectionAlone) {
  const int plain = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(port_);
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(::connect(plain, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
  const auto request = asking_for("/immediate");
  ASSERT_GT(::send(plain, request.data(), request.size(), MSG_NOSIGNAL), 0);
  char byte = 0;
  while (::recv(plain, &byte, 1, 0) > 0) {
  }
  ::close(plain);
  EXPECT_EQ(server_->counts().requests_total, 0U);
  EXPECT_TRUE(TlsClient(port_).connected());
}

TEST_F(TlsTest, LastAnswer_EndsWithCloseNotify) {
  TlsClient client(port_);
  ASSERT_TRUE(client.send("GET /immediate HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"));
  EXPECT_TRUE(client.read_head().starts_with("HTTP/1.1 200 "));
  EXPECT_TRUE(client.ended_cleanly()) << "a client could not tell the end from a cut";
}

TEST_F(TlsTest, WebSocket_SaysBack_AlsoAfterNewKeys) {
  TlsClient client(port_);
  ASSERT_TRUE(client.send(upgrading));
  EXPECT_TRUE(client.read_head().starts_with("HTTP/1.1 101 "));
  ASSERT_TRUE(client.send(text_frame("hello")));
  EXPECT_EQ(client.read(7), "\x81\x05hello");
  client.update_keys();
  ASSERT_TRUE(client.send(text_frame("again")));
  EXPECT_EQ(client.read(7),
            "\x81\x05"
            "again");
}

TEST_F(TlsTest, ClientThatReadsLate_GetsEveryByteInOrder) {
  constexpr int small_buffer = 4096;
  TlsClient client(port_, 0, 0, small_buffer);
  ASSERT_TRUE(client.send(upgrading));
  EXPECT_TRUE(client.read_head().starts_with("HTTP/1.1 101 "));
  // More than the kernel's buffers hold, so that records are encrypted before the socket accepts them.
  constexpr int messages = 20;
  constexpr std::size_t size = 40'000;
  for (int i = 0; i < messages; ++i)
    ASSERT_TRUE(client.send(text_frame(std::string(size, static_cast<char>('a' + i)))));
  for (int i = 0; i < messages; ++i) {
    const auto head = client.read(4);
    ASSERT_EQ(head.size(), 4U);
    EXPECT_EQ(head.substr(0, 2), "\x81\x7E");
    EXPECT_EQ(client.read(size), std::string(size, static_cast<char>('a' + i)));
  }
}

TEST_F(TlsTest, NewCertificate_IsForNewConnections_AndNoneIsLost) {
  TlsClient old(port_);
  EXPECT_EQ(old.certificate_name(), "first");
  ASSERT_TRUE(old.send(upgrading));
  EXPECT_TRUE(old.read_head().starts_with("HTTP/1.1 101 "));
  files_ = certificate_in(folder_, "second");
  server_->set_tls(TlsContext::load(files_).value());
  EXPECT_EQ(TlsClient(port_).certificate_name(), "second");
  ASSERT_TRUE(old.send(text_frame("still")));
  EXPECT_EQ(old.read(7), "\x81\x05still");
}

TEST_F(TlsTest, BothDoors_AreOpen) {
  const int plain = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(plain_port_);
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(::connect(plain, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
  const auto request = asking_for("/immediate");
  ASSERT_GT(::send(plain, request.data(), request.size(), MSG_NOSIGNAL), 0);
  std::string answer(12, ' ');
  EXPECT_EQ(::recv(plain, answer.data(), answer.size(), MSG_WAITALL), 12);
  EXPECT_EQ(answer, "HTTP/1.1 200");
  ::close(plain);
}

TEST(TlsFiles, ThatCannotBeUsed_AreNamed) {
  const auto folder = std::filesystem::temp_directory_path() / ("semblante-tls-files-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder / "a");
  std::filesystem::create_directories(folder / "b");
  const auto a = certificate_in(folder / "a", "a");
  const auto b = certificate_in(folder / "b", "b");
  const auto missing = TlsContext::load({folder / "none.pem", a.key});
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().where, "--tls-cert");
  EXPECT_NE(missing.error().message.find("none.pem"), std::string::npos);
  const auto other_key = TlsContext::load({a.certificate, b.key});
  ASSERT_FALSE(other_key);
  EXPECT_EQ(other_key.error().where, "--tls-key");
  std::ofstream(folder / "text.pem") << "no certificate";
  EXPECT_FALSE(TlsContext::load({folder / "text.pem", a.key}));
  const auto good = TlsContext::load({a.certificate, a.key});
  ASSERT_TRUE(good);
  EXPECT_EQ((*good)->names(), (std::vector<std::string>{"localhost", "127.0.0.1"}));
  EXPECT_GT((*good)->expires(), std::chrono::system_clock::now());
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace semblante::net

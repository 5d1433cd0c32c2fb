// What one address may have open. This machine's loopback addresses have no such limit, so these tests come by another
// address of the machine.

#include <filesystem>
#include <ifaddrs.h>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <net/if.h>

#include "server/net/self_signed.h"
#include "server/net/server.h"
#include "server/net/tls_context.h"
#include "tests/support/tls_client.h"
#include "tests/support/wait.h"
#include "tests/unit/net/echo_application.h"
#include "tests/unit/net/raw_client.h"

namespace semblante::net {
namespace {

using semblante::testing::eventually;
using semblante::testing::TlsClient;

/// An IPv4 address of this machine in its network, in the byte order of the host.
std::optional<std::uint32_t> own_address() {
  ifaddrs* all = nullptr;
  if (::getifaddrs(&all) != 0) return std::nullopt;
  std::optional<std::uint32_t> found;
  for (const auto* one = all; one != nullptr && !found; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    if ((one->ifa_flags & IFF_UP) == 0 || (one->ifa_flags & IFF_LOOPBACK) != 0) continue;
    found = ntohl(reinterpret_cast<const sockaddr_in*>(one->ifa_addr)->sin_addr.s_addr);
  }
  ::freeifaddrs(all);
  return found;
}

class AddressLimits : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto own = own_address();
    if (!own) GTEST_SKIP() << "this machine has loopback addresses only";
    own_ = *own;
    std::filesystem::create_directories(folder_);
    ServerConfig config;
    config.listeners = {{"0.0.0.0", 0, true}, {"0.0.0.0", 0, false}};
    config.limits.header_timeout = config.limits.idle_timeout = 10 * semblante::testing::patience;
    config.limits.max_connections_per_address = most_connections;
    config.limits.max_handshakes_per_address = most_handshakes;
    server_ = std::make_unique<Server>(config, application_);
    const auto ports = server_->listen().value();
    tls_port_ = ports[0];
    port_ = ports[1];
    const TlsFiles files{folder_ / "certificate.pem", folder_ / "key.pem"};
    ASSERT_TRUE(write_self_signed(files, "own", {"localhost"}, std::chrono::hours(1)));
    server_->set_tls(TlsContext::load(files).value());
    thread_ = std::thread([this] { server_->run([] {}); });
  }
  void TearDown() override {
    if (!thread_.joinable()) return;
    server_->stop();
    thread_.join();
    std::filesystem::remove_all(folder_);
  }

  [[nodiscard]] bool are_open(std::uint64_t number) const {
    return eventually([&] { return server_->counts().connections_open == number; });
  }
  static std::vector<std::unique_ptr<Client>> some(std::size_t number, std::uint16_t port, std::uint32_t address) {
    std::vector<std::unique_ptr<Client>> clients;
    for (std::size_t i = 0; i < number; ++i) clients.push_back(std::make_unique<Client>(port, address));
    return clients;
  }

  static constexpr std::uint32_t most_connections = 6, most_handshakes = 3;
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("semblante-address-" + std::to_string(::getpid()));
  EchoApplication application_;
  std::unique_ptr<Server> server_;
  std::thread thread_;
  std::uint16_t tls_port_ = 0, port_ = 0;
  std::uint32_t own_ = 0;
};

TEST_F(AddressLimits, Connections_BeyondTheLimit_Get503) {
  auto clients = some(most_connections, port_, own_);
  ASSERT_TRUE(are_open(most_connections));
  const Client next(port_, own_);
  const auto head = next.read_head();
  EXPECT_TRUE(head.starts_with("HTTP/1.1 503 ")) << head;
  EXPECT_NE(head.find("Retry-After: "), std::string::npos);
  const auto others = some(most_connections + 1, port_, INADDR_LOOPBACK);
  EXPECT_TRUE(are_open(2 * most_connections + 1)) << "this machine has no limit";
  clients.pop_back();
  EXPECT_TRUE(are_open(2 * most_connections));
  const Client again(port_, own_);
  again.send(get("/immediate"));
  EXPECT_TRUE(again.read_head().starts_with("HTTP/1.1 200 "));
}

TEST_F(AddressLimits, HandshakesThatAreNotDone_HaveALimit_AndOthersAreServed) {
  auto half_open = some(most_handshakes, tls_port_, own_);
  half_open.front()->send("\x16\x03\x01");  // the first bytes of a ClientHello
  ASSERT_TRUE(are_open(most_handshakes));
  EXPECT_FALSE(TlsClient(tls_port_, 0, 0, 0, own_).connected());
  EXPECT_EQ(server_->counts().connections_refused, 1U);
  EXPECT_TRUE(TlsClient(tls_port_).connected()) << "another address";
  const Client plain(port_, own_);
  plain.send(get("/immediate"));
  EXPECT_TRUE(plain.read_head().starts_with("HTTP/1.1 200 ")) << "no handshake";
  half_open.pop_back();
  ASSERT_TRUE(are_open(most_handshakes));
  EXPECT_TRUE(TlsClient(tls_port_, 0, 0, 0, own_).connected()) << "a place is free again";
}

TEST_F(AddressLimits, HandshakesThatAreDone_DoNotCount) {
  std::vector<std::unique_ptr<TlsClient>> clients;
  for (std::uint32_t i = 0; i < most_handshakes + 2; ++i) {
    clients.push_back(std::make_unique<TlsClient>(tls_port_, 0, 0, 0, own_));
    ASSERT_TRUE(clients.back()->connected()) << i;
    // The client is ready before the server has read its last message.
    ASSERT_TRUE(clients.back()->send(get("/immediate")));
    EXPECT_TRUE(clients.back()->read_head().starts_with("HTTP/1.1 200 "));
  }
  EXPECT_TRUE(are_open(most_handshakes + 2));
}

}  // namespace
}  // namespace semblante::net

// The client of the command line under servers that do not keep to the protocol.

#include "server/net/http_client.h"

#include <gtest/gtest.h>

#include "tests/unit/client/canned_server.h"

namespace semblante::net {
namespace {

Result<ClientResponse> ask_for_chunks(const std::string& chunks) {
  const testing::CannedServer server("HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\n" + chunks);
  return ask(*parse_server_address(server.url()), {"GET", "/", "", ""});
}

TEST(HttpClient, WhatSurroundsChunks_IsBounded) {
  const auto good = ask_for_chunks("2;e=f\r\nhi\r\n0\r\nX: y\r\n\r\n");
  ASSERT_TRUE(good);
  EXPECT_EQ(good->body, "hi");
  EXPECT_FALSE(ask_for_chunks("0\r\nX: " + std::string(66'000, 'a') + "\r\n\r\n"));
  EXPECT_FALSE(ask_for_chunks("1;" + std::string(1U << 20U, 'e') + "\r\nx\r\n0\r\n\r\n"));
}

}  // namespace
}  // namespace semblante::net

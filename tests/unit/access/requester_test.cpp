#include "server/access/requester.h"

#include <vector>

#include <gtest/gtest.h>

namespace semblante::access {
namespace {

const std::vector<http::AddressRange> proxies = {*http::AddressRange::parse("10.0.0.0/8"),
                                                 *http::AddressRange::parse("127.0.0.1")};

http::Request from(const std::string& peer, const std::string& forwarded, const std::string& scheme = {}) {
  http::Request request;
  request.peer = peer;
  if (!forwarded.empty()) request.headers["X-Forwarded-For"] = forwarded;
  if (!scheme.empty()) request.headers["X-Forwarded-Proto"] = scheme;
  return request;
}

TEST(Requester, Stranger_IsNotBelieved) {
  const auto requester = requester_of(from("203.0.113.9", "198.51.100.1", "https"), proxies);
  EXPECT_EQ(requester.address, "203.0.113.9");
  EXPECT_FALSE(requester.secure);
}

TEST(Requester, Proxy_NamesItsClient) {
  const auto requester = requester_of(from("127.0.0.1", "198.51.100.1", "https"), proxies);
  EXPECT_EQ(requester.address, "198.51.100.1");
  EXPECT_TRUE(requester.secure);
  EXPECT_EQ(requester_of(from("127.0.0.1", ""), proxies).address, "127.0.0.1");
}

TEST(Requester, WhatTheClientSaysItself_IsNotBelieved) {
  // The client has sent "8.8.8.8" as if it were a proxy; the first proxy has appended the client's address.
  const auto requester = requester_of(from("127.0.0.1", "8.8.8.8, 198.51.100.1, 10.1.2.3"), proxies);
  EXPECT_EQ(requester.address, "198.51.100.1");
  EXPECT_EQ(requester_of(from("127.0.0.1", "198.51.100.1, unknown"), proxies).address, "127.0.0.1");
}

TEST(AddressRange, HoldsItsAddresses) {
  const auto in = [](const char* range, const char* address) {
    const auto parsed = http::AddressRange::parse(range);
    return parsed && parsed->contains(*http::parse_address(address));
  };
  EXPECT_TRUE(in("10.0.0.0/8", "10.255.0.1"));
  EXPECT_FALSE(in("10.0.0.0/8", "11.0.0.1"));
  EXPECT_TRUE(in("192.168.4.0/22", "192.168.7.255"));
  EXPECT_FALSE(in("192.168.4.0/22", "192.168.8.0"));
  EXPECT_TRUE(in("2001:db8::/33", "2001:db8:7fff::1"));
  EXPECT_FALSE(in("2001:db8::/33", "2001:db8:8000::1"));
  EXPECT_TRUE(in("0.0.0.0/0", "1.2.3.4"));
  EXPECT_FALSE(in("0.0.0.0/0", "2001:db8::1"));
  EXPECT_TRUE(in("127.0.0.1", "::ffff:127.0.0.1"));
  for (const char* text : {"", "10.0.0", "10.0.0.0/33", "10.0.0.0/", "10.0.0.0/8x", "::/129", "10.0.0.0/-1"})
    EXPECT_FALSE(http::AddressRange::parse(text)) << text;
}

TEST(AddressRange, ClientNetwork_IsAnAddressOrSixtyFourBits) {
  const auto network = [](const char* text) { return http::client_network(*http::parse_address(text)); };
  EXPECT_EQ(network("2001:db8::1"), network("2001:db8::ffff:1"));
  EXPECT_NE(network("2001:db8::1"), network("2001:db8:0:1::1"));
  EXPECT_NE(network("198.51.100.1"), network("198.51.100.2"));
}

}  // namespace
}  // namespace semblante::access

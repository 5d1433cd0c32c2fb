#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "clients/native/plain/http_answer.h"
#include "clients/native/plain/web_socket_key.h"
#include "clients/native/plain/web_socket_reader.h"

namespace semblante::testing {
namespace {

using client::HttpAnswer;
using client::HttpLimits;
using client::web_socket_frame;
using client::WebSocketKind;
using client::WebSocketReader;
using Bytes = std::vector<std::uint8_t>;

constexpr HttpLimits answer_limits = {.max_body = 1000, .max_header = 2000, .timeout = {}};

/// The body of an answer that is taken in pieces of `size` bytes; "..." if it is not whole, "!" for an error.
std::string body_of(const std::string& answer, std::size_t size) {
  HttpAnswer reader(answer_limits, false);
  for (std::size_t at = 0; at < answer.size(); at += size) {
    const auto taken = reader.take(std::string_view(answer).substr(at, size));
    if (!taken) return "!";
    if (*taken) return reader.response().body;
  }
  return reader.close() ? reader.response().body : "...";
}

TEST(HttpAnswer, InPiecesOfAnySize_IsTheSame) {
  const std::string begin = "HTTP/1.1 200 OK\r\n";
  for (const std::size_t size : {1U, 2U, 7U, 10'000U}) {
    EXPECT_EQ(body_of(begin + "Content-Length: 5\r\n\r\nhello", size), "hello");
    EXPECT_EQ(body_of(begin + "Content-Length: 0\r\n\r\n", size), "");
    EXPECT_EQ(body_of(begin + "\r\nuntil it closes", size), "until it closes");
    EXPECT_EQ(
        body_of(begin + "Transfer-Encoding: Chunked\r\n\r\n3;x=y\r\nabc\r\nA\r\n0123456789\r\n0\r\nT: t\r\n\r\n", size),
        "abc0123456789");
    EXPECT_EQ(body_of("HTTP/1.1 100 Continue\r\n\r\n" + begin + "Content-Length: 2\r\n\r\nhi", size), "hi");
    EXPECT_EQ(body_of("HTTP/1.1 304 Not Modified\r\nContent-Length: 9\r\n\r\n", size), "");
    EXPECT_EQ(body_of(begin + "Content-Length: 5\r\n\r\nhell", size), "...");
  }
}

TEST(HttpAnswer, Malformed_IsRefused) {
  const std::string begin = "HTTP/1.1 200 OK\r\n";
  for (const std::string& bad :
       {std::string("HTTP/2 200\r\n\r\n"), std::string("HTTP/1.1 2x0 OK\r\n\r\n"),
        std::string("HTTP/1.1 99 OK\r\n\r\n"), begin + "Content-Length: -1\r\n\r\n",
        begin + "Content-Length: 1\r\nContent-Length: 2\r\n\r\nab", begin + "Content-Length: 1x\r\n\r\na",
        begin + "no colon\r\n\r\n", begin + "a b: c\r\n\r\n", begin + "Transfer-Encoding: gzip, chunked\r\n\r\n",
        begin + "Transfer-Encoding: chunked\r\nContent-Length: 1\r\n\r\n",
        begin + "Transfer-Encoding: chunked\r\n\r\nxyz\r\n", begin + "Transfer-Encoding: chunked\r\n\r\n2\r\nabc\r\n",
        begin + "Transfer-Encoding: chunked\r\n\r\nFFFFFFFFFFFFFFFFF\r\n",
        begin + "Transfer-Encoding: chunked\r\n\r\n3E9\r\n", begin + "Content-Length: 1001\r\n\r\n"}) {
    EXPECT_EQ(body_of(bad, 1), "!") << bad;
    EXPECT_EQ(body_of(bad, 10'000), "!") << bad;
  }
}

Bytes server_frame(std::uint8_t first, const std::string& text) {
  Bytes frame = {first, static_cast<std::uint8_t>(text.size())};
  frame.insert(frame.end(), text.begin(), text.end());
  return frame;
}

/// All messages in `bytes`, taken in pieces of `size`: the kind and the text of each; "!" for an error.
std::string messages_in(const Bytes& bytes, std::size_t size) {
  WebSocketReader reader(1000);
  std::string all;
  for (std::size_t at = 0; at < bytes.size(); at += size) {
    reader.take(std::span(bytes).subspan(at, std::min(size, bytes.size() - at)));
    while (true) {
      const auto message = reader.next();
      if (!message) return all + "!";
      if (!*message) break;
      all += std::to_string(static_cast<int>((*message)->kind)) + ":" +
             std::string((*message)->bytes.begin(), (*message)->bytes.end()) + ";";
    }
  }
  return all;
}

TEST(WebSocketReader, FragmentsWithAPingBetween_InPiecesOfAnySize) {
  Bytes bytes;
  for (const Bytes& frame : {server_frame(0x02, "fa"), server_frame(0x89, "p"), server_frame(0x00, ""),
                             server_frame(0x80, "ce"), server_frame(0x81, "text"), server_frame(0x82, "")}) {
    bytes.insert(bytes.end(), frame.begin(), frame.end());
  }
  for (const std::size_t size : {1U, 3U, 100U}) {
    EXPECT_EQ(messages_in(bytes, size), "9:p;2:face;1:text;2:;");
  }
}

TEST(WebSocketReader, LongLengths) {
  Bytes bytes = {0x82, 126, 0x01, 0x00};
  bytes.resize(4 + 256, 'x');
  EXPECT_EQ(messages_in(bytes, 5), "2:" + std::string(256, 'x') + ";");
}

TEST(WebSocketReader, WhatNoServerMaySend_IsAnError) {
  for (const Bytes& bad : {Bytes{0xC2, 0}, Bytes{0x83, 0}, Bytes{0x8B, 0}, Bytes{0x82, 0x80}, Bytes{0x80, 0},
                           Bytes{0x09, 0}, Bytes{0x89, 126, 0, 126}, Bytes{0x82, 126, 0, 125},
                           Bytes{0x82, 127, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF}, Bytes{0x02, 0, 0x82, 0}}) {
    EXPECT_EQ(messages_in(bad, 1), "!");
  }
}

TEST(WebSocketReader, TooLarge_IsKnownFromTheHead_AlsoOfFragments) {
  WebSocketReader reader(10);
  reader.take(Bytes{0x82, 11});
  const auto message = reader.next();
  ASSERT_FALSE(message);
  EXPECT_EQ(message.error().code, ErrorCode::too_large);
  WebSocketReader fragments(10);
  fragments.take(server_frame(0x02, "123456"));
  ASSERT_TRUE(fragments.next());
  fragments.take(server_frame(0x80, "12345"));
  EXPECT_FALSE(fragments.next());
}

TEST(WebSocketFrame, IsMaskedAndHasTheShortestLength) {
  const Bytes abcde = {'a', 'b', 'c', 'd', 'e'};
  EXPECT_EQ(web_socket_frame(WebSocketKind::binary, abcde, 0x01020304),
            (Bytes{0x82, 0x85, 1, 2, 3, 4, 'a' ^ 1, 'b' ^ 2, 'c' ^ 3, 'd' ^ 4, 'e' ^ 1}));
  EXPECT_EQ(web_socket_frame(WebSocketKind::text, Bytes(126), 0).size(), 4U + 4U + 126U);
  EXPECT_EQ(web_socket_frame(WebSocketKind::text, Bytes(65'536), 0).size(), 10U + 4U + 65'536U);
}

TEST(WebSocketKey, OfTheStandard) {
  EXPECT_EQ(client::web_socket_accept("dGhlIHNhbXBsZSBub25jZQ=="), "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=");
}

}  // namespace
}  // namespace semblante::testing

#include "server/http/wire_message.h"

#include <gtest/gtest.h>

namespace semblante::http {
namespace {

using namespace std::string_literals;

// RFC 6455 section 5.2: FIN and opcode (1 text, 2 binary), no mask, 7, 7 + 16 or 7 + 64 bits of length.
TEST(WireMessage, HasTheHeaderOfItsLength) {
  EXPECT_EQ(make_wire("Hello", false)->bytes, "\x81\x05Hello");
  EXPECT_EQ(make_wire("", true)->bytes, "\x82\x00"s);
  const auto header = [](std::size_t size) {
    const auto bytes = make_wire(std::string(size, 'x'), true)->bytes;
    EXPECT_EQ(bytes.substr(bytes.size() - size), std::string(size, 'x'));
    return bytes.substr(0, bytes.size() - size);
  };
  EXPECT_EQ(header(125), "\x82\x7D");
  EXPECT_EQ(header(126), "\x82\x7E\x00\x7E"s);
  EXPECT_EQ(header(65535), "\x82\x7E\xFF\xFF");
  EXPECT_EQ(header(65536), "\x82\x7F\x00\x00\x00\x00\x00\x01\x00\x00"s);
}

TEST(WireMessage, SeveralFollowEachOther) {
  std::string wire;
  append_message(wire, "a", true);
  append_message(wire, "bc", false);
  EXPECT_EQ(wire, "\x82\x01"s + "a" + "\x81\x02" + "bc");
}

}  // namespace
}  // namespace semblante::http

#include "clients/native/viewer/address.h"

#include <gtest/gtest.h>

namespace semblante::testing {
namespace {

using viewer::parse_stream_address;

TEST(StreamAddress, WebSocketPageAndServer_NameServerAndStream) {
  const struct {
    const char* text;
    const char* server;
    const char* stream;
  } cases[] = {
      {"ws://127.0.0.1:8080/v1/streams/demo", "http://127.0.0.1:8080", "demo"},
      {"wss://faces.example/base/v1/streams/a%20b/", "https://faces.example/base", "a b"},
      {"http://[::1]:8080/view/demo?x=1", "http://[::1]:8080", "demo"},
      {"https://faces.example", "https://faces.example", ""},
      {"ws://faces.example", "http://faces.example", ""},
  };
  for (const auto& each : cases) {
    const auto address = parse_stream_address(each.text);
    ASSERT_TRUE(address) << each.text;
    EXPECT_EQ(address->server, each.server) << each.text;
    EXPECT_EQ(address->stream, each.stream) << each.text;
  }
}

TEST(StreamAddress, BadPercentEncoding_IsRefused) {
  for (const char* text :
       {"ws://h/v1/streams/%", "ws://h/v1/streams/%4", "ws://h/v1/streams/%zz", "http://h/view/%-1"}) {
    EXPECT_FALSE(parse_stream_address(text)) << text;
  }
}

}  // namespace
}  // namespace semblante::testing

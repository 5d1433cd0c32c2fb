#include "clients/native/client/live_stream.h"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>
#include <gtest/gtest.h>

#include "clients/native/client/frame_player.h"
#include "clients/native/client/stream_publisher.h"
#include "protocol/cpp/json_codec.h"
#include "tests/support/frame_encoder.h"
#include "tests/support/wait.h"
#include "tests/unit/client/canned_server.h"

namespace semblante::testing {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using client::FramePlayer;
using client::LiveStream;
using client::LiveStreamOptions;
using client::StreamSocket;
using Socket = websocket::stream<asio::ip::tcp::socket>;

/// A server for one connection that says what a test wants it to say.
class ScriptedServer {
 public:
  ScriptedServer(std::string protocol, std::function<void(Socket&)> script, int connections = 1)
      : acceptor_(io_, {asio::ip::make_address("127.0.0.1"), 0}),
        thread_([this, protocol = std::move(protocol), script = std::move(script), connections] {
          for (int i = 0; i < connections; ++i) serve(protocol, script);
        }) {}
  ~ScriptedServer() { thread_.join(); }
  ScriptedServer(const ScriptedServer&) = delete;
  ScriptedServer& operator=(const ScriptedServer&) = delete;

  [[nodiscard]] client::Url url() const { return {"127.0.0.1", std::to_string(acceptor_.local_endpoint().port()), ""}; }
  [[nodiscard]] const std::string& hello() const { return hello_; }

 private:
  void serve(const std::string& protocol, const std::function<void(Socket&)>& script) {
    beast::error_code problem;
    Socket socket(acceptor_.accept());
    socket.set_option(websocket::stream_base::decorator([&](websocket::response_type& response) {
      if (!protocol.empty()) {
        response.set(beast::http::field::sec_websocket_protocol, protocol);
      }
    }));
    socket.accept(problem);
    beast::flat_buffer hello;
    if (!problem) {
      socket.read(hello, problem);
    }
    if (!problem) {
      hello_ = beast::buffers_to_string(hello.data());
      script(socket);
      socket.read(hello, problem);  // until the client goes
    }
  }

  asio::io_context io_;
  asio::ip::tcp::acceptor acceptor_;
  std::string hello_;
  std::thread thread_;
};

void say(Socket& socket, FrameEncoder& encoder, const Message& message) {
  const std::vector<std::uint8_t> bytes = encoder.encode(message);
  beast::error_code problem;
  socket.binary(true);
  socket.write(asio::buffer(bytes), problem);
}

FaceFrame with_jaw(std::int16_t level) {
  FaceFrame frame;
  frame.level[3] = level;
  return frame;
}

/// The script of a server begins when anything was said to it.
constexpr std::array<std::uint8_t, 1> hello_bytes = {0};

Header named_header() {
  Header header;
  header.stream = "show";
  header.model = "sample";
  header.quantizers.assign(low_level_fap_count, 1.0);
  header.quantizers[0] = 4.0;  // FAP 3
  return header;
}

/// The first event of this type; NONE when it does not come.
runtime::Event event_of(LiveStream& stream, semblante_event_type type) {
  const auto deadline = LiveStream::Clock::now() + patience;
  while (LiveStream::Clock::now() < deadline) {
    auto event = stream.next(std::chrono::milliseconds(50));
    if (event && event->type == type) return *std::move(event);
  }
  return {};
}

TEST(StreamSocket, HostileServer_IsAnError) {
  {  // Nobody there.
    const auto socket = StreamSocket::open(client::Url{"127.0.0.1", "1", ""}, "s");
    ASSERT_FALSE(socket);
    EXPECT_EQ(socket.error().code, ErrorCode::io);
  }
  // No such stream; no server of faces.
  struct Refusal {
    const char *body, *words;
    ErrorCode code;
  };
  for (const auto& [body, words, code] :
       {Refusal{R"({"type":"/problems/not-found","status":404})", "no such stream", ErrorCode::missing},
        Refusal{"<p>There is no such page</p>", "no Semblante server", ErrorCode::io},
        Refusal{"", "no Semblante server", ErrorCode::io}}) {
    SCOPED_TRACE(body);
    const CannedServer server("HTTP/1.1 404 Not Found\r\nContent-Length: " +
                              std::to_string(std::string_view(body).size()) + "\r\n\r\n" + body);
    const auto socket = StreamSocket::open(*client::parse_url(server.url()), "s");
    ASSERT_FALSE(socket);
    EXPECT_EQ(socket.error().code, code);
    EXPECT_NE(socket.error().message.find(words), std::string::npos) << socket.error().message;
  }
  {  // Silence.
    const CannedServer server("");
    const auto socket = StreamSocket::open(*client::parse_url(server.url()), "s",
                                           {.json = false, .timeout = std::chrono::milliseconds(100)});
    ASSERT_FALSE(socket);
    EXPECT_EQ(socket.error().code, ErrorCode::io);
  }
  {  // Another subprotocol, and none.
    for (const char* protocol : {"semblante.v9", ""}) {
      const ScriptedServer server(protocol, [](Socket&) {});
      const auto socket = StreamSocket::open(server.url(), "s");
      ASSERT_FALSE(socket);
      EXPECT_EQ(socket.error().code, ErrorCode::mismatch);
    }
  }
  {  // A message larger than any.
    const ScriptedServer server("semblante.v1", [](Socket& socket) {
      beast::error_code problem;
      socket.binary(true);
      socket.write(asio::buffer(std::string(max_binary_message_bytes + 1, 'x')), problem);
    });
    auto socket = StreamSocket::open(server.url(), "s");
    ASSERT_TRUE(socket);
    ASSERT_TRUE(socket->send(hello_bytes));
    const auto message = socket->read(patience);
    ASSERT_FALSE(message);
    EXPECT_EQ(message.error().code, ErrorCode::too_large);
  }
}

TEST(StreamSocket, Read_WaitsNoLongerThanAsked_ForAServerThatFloods) {
  for (const char* flood : {"\x8A\x00", "\x00\x00"}) {  // pongs; fragments of a message that never ends
    SCOPED_TRACE(static_cast<int>(flood[0]));
    const ScriptedServer server("semblante.v1", [flood](Socket& socket) {
      std::string frames("\x02\x00", 2);  // the message begins
      for (int i = 0; i < 10'000; ++i) frames.append(flood, 2);
      beast::error_code problem;
      asio::write(socket.next_layer(), asio::buffer(frames), problem);
      while (!problem) asio::write(socket.next_layer(), asio::buffer(frames.data() + 2, frames.size() - 2), problem);
    });
    auto socket = StreamSocket::open(server.url(), "s");
    ASSERT_TRUE(socket);
    ASSERT_TRUE(socket->send(hello_bytes));
    const auto bytes = socket->read(std::chrono::milliseconds(30));
    ASSERT_TRUE(bytes);
    EXPECT_FALSE(bytes->has_value());
  }
}

TEST(StreamSocket, Close_TellsTheReason) {
  const ScriptedServer server("semblante.v1", [](Socket& socket) {
    beast::error_code problem;
    socket.close({websocket::close_code::try_again_later, "slow"}, problem);
  });
  auto socket = StreamSocket::open(server.url(), "s");
  ASSERT_TRUE(socket);
  ASSERT_TRUE(socket->send(hello_bytes));
  EXPECT_FALSE(socket->read(patience));
  EXPECT_EQ(socket->close_code(), 1013);
  EXPECT_EQ(socket->close_reason(), "slow");
}

TEST(StreamPublisher, ServerThatMakesNoStream_IsQuotedByItsProblem) {
  const std::string body =
      R"({"type":"/problems/not-found","title":"Nothing is made here","status":404,"pointer":"/name","detail":"is odd"})";
  const CannedServer server(
      "HTTP/1.1 404 Not Found\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body, 2);
  client::PublisherOptions options;
  options.create = true;
  client::StreamPublisher publisher(*client::parse_url(server.url()), "s", options);
  const Status done = publisher.look_after();
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().message,
            "the server does not create this stream: the server answered 404: Nothing is made here: /name: is odd");
}

TEST(StreamPublisher, StreamThatIsDeleted_IsToldAsDeleted) {
  const ScriptedServer server("semblante.v1", [](Socket& socket) {
    FrameEncoder encoder;
    say(socket, encoder, named_header());
    say(socket, encoder, End{EndReason::deleted});
  });
  client::StreamPublisher publisher(server.url(), "show", {});
  std::string news;
  ASSERT_TRUE(eventually([&] {
    EXPECT_TRUE(publisher.look_after());
    if (auto more = publisher.take_news()) news += *more + "; ";
    return news.find("no connection") != std::string::npos;
  }));
  publisher.close();
  EXPECT_NE(news.find("no connection to show: the stream was deleted"), std::string::npos) << news;
}

TEST(LiveStream, MessageThatIsNone_IsAFault) {
  const ScriptedServer server("semblante.v1", [](Socket& socket) {
    beast::error_code problem;
    socket.binary(true);
    socket.write(asio::buffer("\x09\xFF\xFF\xFF", 4), problem);
  });
  LiveStream stream(server.url(), "s");
  const runtime::Event fault = event_of(stream, SEMBLANTE_EVENT_FAULT);
  ASSERT_EQ(fault.type, SEMBLANTE_EVENT_FAULT);
  EXPECT_FALSE(fault.error->message.empty());
}

TEST(LiveStream, Next_WaitsNoLongerThanAsked) {
  const ScriptedServer server("semblante.v1", [](Socket&) {});
  LiveStream stream(server.url(), "s");
  ASSERT_EQ(event_of(stream, SEMBLANTE_EVENT_STATE).state, std::uint32_t{SEMBLANTE_STREAM_CONNECTING});
  for (int i = 0; i < 2; ++i) {
    const auto event = stream.next(std::chrono::milliseconds(30));
    ASSERT_TRUE(event);
    EXPECT_EQ(event->type, SEMBLANTE_EVENT_NONE);
  }
}

TEST(LiveStream, JsonSubprotocol_SpeaksText) {
  const ScriptedServer server("semblante.v1.json", [](Socket& socket) {
    EXPECT_TRUE(socket.got_text());
    beast::error_code problem;
    socket.text(true);
    socket.write(asio::buffer(encode_json(Message(named_header()))), problem);
  });
  LiveStreamOptions options;
  options.socket.json = true;
  options.role = StreamRole::publish;
  LiveStream stream(server.url(), "s", options);
  ASSERT_EQ(event_of(stream, SEMBLANTE_EVENT_HEADER).type, SEMBLANTE_EVENT_HEADER);
  EXPECT_EQ(stream.header()->model, "sample");
  EXPECT_NE(server.hello().find("publish"), std::string::npos) << server.hello();
}

/// 100 ms: jaw 0, 200 ms: jaw 10 levels of 4 units, 300 ms: jaw 20 levels, then the end.
void three_frames(Socket& socket) {
  FrameEncoder encoder;
  say(socket, encoder, named_header());
  say(socket, encoder, Keyframe{1, 100, with_jaw(0)});
  say(socket, encoder, Frames{2, 200, {{0, with_jaw(10)}, {100, with_jaw(20)}}});
  say(socket, encoder, End{EndReason::finished});
}

TEST(FramePlayer, NextReceived_GivesEachFrameInFapUnits) {
  const ScriptedServer server("semblante.v1", three_frames);
  LiveStream stream(server.url(), "s");
  FramePlayer player(stream, patience);
  const std::array<float, 3> jaws = {0, 40, 80};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto frame = player.next_received();
    ASSERT_TRUE(frame) << frame.error().message;
    ASSERT_TRUE(frame->has_value());
    EXPECT_EQ((*frame)->sequence, i + 1);
    EXPECT_EQ((*frame)->media_time, 100.0 * static_cast<double>(i + 1));
    EXPECT_EQ((*frame)->frame.fap[3], jaws[i]);
  }
  const auto end = player.next_received();
  ASSERT_TRUE(end);
  EXPECT_FALSE(end->has_value());
}

TEST(FramePlayer, At_GivesTheTwoFramesAroundAndTheShare) {
  const ScriptedServer server("semblante.v1", three_frames);
  LiveStream stream(server.url(), "s");
  FramePlayer player(stream, patience);
  {
    const auto before = player.at(50);
    ASSERT_TRUE(before && before->has_value());
    EXPECT_EQ((*before)->from.sequence, 1U);
    EXPECT_EQ((*before)->to.sequence, 1U);
  }
  {
    // A quarter of the way from 100 to 200.
    const auto between = player.at(125);
    ASSERT_TRUE(between && between->has_value());
    EXPECT_EQ((*between)->from.sequence, 1U);
    EXPECT_EQ((*between)->to.sequence, 2U);
    EXPECT_FLOAT_EQ((*between)->t, 0.25F);
  }
  {
    const auto later = player.at(290);
    ASSERT_TRUE(later && later->has_value());
    EXPECT_EQ((*later)->to.sequence, 3U);
    EXPECT_FLOAT_EQ((*later)->t, 0.9F);
  }
  const auto after = player.at(400);
  ASSERT_TRUE(after) << after.error().message;
  EXPECT_FALSE(after->has_value());
}

TEST(FramePlayer, ServersError_IsPassedOn) {
  const ScriptedServer server("semblante.v1", [](Socket& socket) {
    FrameEncoder encoder;
    say(socket, encoder, StreamError{StreamErrorCode::not_found, "/role", "nothing here"});
  });
  LiveStream stream(server.url(), "s");
  FramePlayer player(stream, patience);
  const Status header = player.wait_for_header();
  ASSERT_FALSE(header);
  EXPECT_EQ(header.error().code, ErrorCode::missing);
  EXPECT_EQ(header.error().where, "stream/role");
}

/// As a server that lost the connection and starts from a keyframe that the client has.
TEST(FramePlayer, FrameThatIsSentAgain_ComesOnce) {
  const ScriptedServer server("semblante.v1", [](Socket& socket) {
    FrameEncoder encoder;
    say(socket, encoder, named_header());
    say(socket, encoder, Keyframe{1, 100, with_jaw(0)});
    say(socket, encoder, Frames{2, 200, {{0, with_jaw(10)}}});
    say(socket, encoder, Keyframe{2, 200, with_jaw(10)});
    say(socket, encoder, Frames{3, 300, {{0, with_jaw(20)}}});
    say(socket, encoder, End{EndReason::finished});
  });
  LiveStream stream(server.url(), "s");
  FramePlayer player(stream, patience);
  for (std::uint64_t sequence = 1; sequence <= 3; ++sequence) {
    const auto frame = player.next_received();
    ASSERT_TRUE(frame && frame->has_value());
    EXPECT_EQ((*frame)->sequence, sequence);
  }
}

TEST(FramePlayer, ServerThatStops_IsWaitedFor) {
  std::uint64_t starts = 0;
  const ScriptedServer server(
      "semblante.v1",
      [&starts](Socket& socket) {
        FrameEncoder encoder;
        Header header = named_header();
        header.epoch = ++starts;
        say(socket, encoder, header);
        say(socket, encoder, Keyframe{1, 100, with_jaw(0)});
        say(socket, encoder, End{starts == 1 ? EndReason::shutdown : EndReason::finished});
        beast::error_code problem;
        socket.close(websocket::close_code::going_away, problem);
      },
      2);
  LiveStream stream(server.url(), "s");
  FramePlayer player(stream, patience);
  for (const bool is_frame : {true, true, false}) {
    const auto frame = player.next_received();
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_EQ(frame->has_value(), is_frame);
  }
}

TEST(FramePlayer, ServerThatFallsSilent_IsWaitedFor) {
  int connections = 0;
  const ScriptedServer server(
      "semblante.v1",
      [&connections](Socket& socket) {
        FrameEncoder encoder;
        say(socket, encoder, named_header());
        say(socket, encoder, Keyframe{1, 100, with_jaw(0)});
        if (++connections == 2) return say(socket, encoder, End{EndReason::finished});
        beast::flat_buffer pings;
        for (beast::error_code problem; !problem;) socket.read(pings, problem);
      },
      2);
  LiveStreamOptions options;
  options.silence_limit = std::chrono::milliseconds(200);
  LiveStream stream(server.url(), "s", options);
  FramePlayer player(stream, patience);
  for (const bool is_frame : {true, false}) {  // the second connection has the same frame, which comes once
    const auto frame = player.next_received();
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_EQ(frame->has_value(), is_frame);
  }
  EXPECT_EQ(stream.connections(), 2U);
}

TEST(FramePlayer, NobodyThere_IsSaidAtOnce) {
  LiveStream stream(client::Url{"127.0.0.1", "1", ""}, "s");
  FramePlayer player(stream, patience);
  const auto begun = LiveStream::Clock::now();
  const Status header = player.wait_for_header();
  ASSERT_FALSE(header);
  EXPECT_EQ(header.error().code, ErrorCode::io);
  EXPECT_LT(LiveStream::Clock::now() - begun, patience);
}

}  // namespace
}  // namespace semblante::testing

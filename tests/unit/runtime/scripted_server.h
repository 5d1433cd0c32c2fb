#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "clients/runtime/semblante.h"
#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/messages.h"
#include "tests/support/frame_encoder.h"

namespace semblante::testing {

/// A face that can be told from others: FAP 3 at `level`.
inline FaceFrame face(int level) {
  FaceFrame state;
  state.level[3] = static_cast<std::int16_t>(level);
  return state;
}

/// What a server with one stream says, message by message, to a `semblante_stream`. It reads with the decoders of the
/// server and keeps everything that happened. Times in ms, chosen by the test.
class ScriptedServer {
 public:
  explicit ScriptedServer(const semblante_stream_options& options = usual()) {
    EXPECT_EQ(semblante_stream_create(&options, &stream, nullptr), SEMBLANTE_OK);
  }
  ~ScriptedServer() { semblante_stream_destroy(stream); }
  ScriptedServer(const ScriptedServer&) = delete;
  ScriptedServer& operator=(const ScriptedServer&) = delete;

  static semblante_stream_options usual() {
    semblante_stream_options options{};
    options.size = sizeof(options);
    options.seed = 1;
    return options;
  }

  /// The events since the last call.
  std::vector<semblante_event> events() {
    std::vector<semblante_event> all;
    semblante_event event{};
    event.size = sizeof(event);
    while (semblante_stream_next_event(stream, &event) != 0) all.push_back(event);
    return all;
  }
  std::vector<std::uint32_t> types() {
    std::vector<std::uint32_t> types;
    for (const semblante_event& event : events()) types.push_back(event.type);
    return types;
  }
  /// The messages that the client has sent since the last call.
  std::vector<Message> sent() {
    std::vector<Message> all;
    std::size_t size = 0;
    while (const std::uint8_t* bytes = semblante_stream_take_bytes(stream, &size)) {
      auto message = from_client_.decode({bytes, size});
      if (!message) {
        ADD_FAILURE() << "the client sent what cannot be read: " << message.error().message;
        continue;
      }
      all.push_back(*message);
    }
    return all;
  }

  void say(const Message& message, double now) { say_bytes(to_client_.encode(message), now); }
  void say_bytes(const std::vector<std::uint8_t>& bytes, double now) {
    EXPECT_EQ(semblante_stream_receive(stream, bytes.data(), bytes.size(), now), SEMBLANTE_OK);
  }
  /// The socket opens, and the client's hello is taken.
  Hello open(double now) {
    from_client_ = {};
    to_client_ = {};
    semblante_stream_opened(stream, now);
    const auto said = sent();
    if (said.size() != 1 || !std::holds_alternative<Hello>(said[0])) {
      ADD_FAILURE() << "a hello must be the first and only message";
      return {};
    }
    return std::get<Hello>(said[0]);
  }
  static Header header(std::uint64_t epoch, std::uint64_t media_time) {
    Header header;
    header.stream = "stage";
    header.title = "The stage";
    header.model = "ana";
    header.epoch = epoch;
    header.media_time = media_time;
    header.fps_hint = 25;
    header.batch_interval = 100;
    return header;
  }
  /// Header and keyframe; frames follow by `batch`.
  void greet(const Header& header, const Keyframe& keyframe, double now) {
    say(header, now);
    say(keyframe, now);
  }
  void batch(std::uint64_t media_time, const std::vector<TimedFrame>& frames, double now) {
    say(Frames{0, media_time, frames}, now);
  }
  /// Started, connected and greeted at `now`, with nothing left to take.
  void begin(double now, std::uint64_t media_time = 5000) {
    semblante_stream_start(stream, now);
    open(now);
    greet(header(7, media_time), {10, media_time, face(0)}, now);
    events();
    sent();
  }

  semblante_stream* stream = nullptr;

 private:
  FrameDecoder from_client_;
  FrameEncoder to_client_;
};

}  // namespace semblante::testing

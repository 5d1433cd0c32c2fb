#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include <gmock/gmock.h>

#include "tests/unit/runtime/owned.h"
#include "tests/unit/runtime/scripted_server.h"

namespace semblante::testing {
namespace {

using ::testing::ElementsAre;

template <class M>
const M* only(const std::vector<Message>& messages) {
  return messages.size() == 1 ? std::get_if<M>(messages.data()) : nullptr;
}

TEST(Stream, FirstConnection_SaysHelloAndGivesWhatComes) {
  ScriptedServer server;
  EXPECT_EQ(semblante_stream_get_state(server.stream), SEMBLANTE_STREAM_CLOSED);
  EXPECT_EQ(semblante_stream_wake_time(server.stream), std::numeric_limits<double>::infinity());
  semblante_stream_start(server.stream, 1000);
  EXPECT_THAT(server.types(), ElementsAre(SEMBLANTE_EVENT_STATE, SEMBLANTE_EVENT_CONNECT));
  semblante_stream_start(server.stream, 1001);
  EXPECT_TRUE(server.events().empty()) << "it is starting already";

  const Hello hello = server.open(1010);
  EXPECT_EQ(hello.role, StreamRole::subscribe);
  EXPECT_FALSE(hello.resume);

  Header header = ScriptedServer::header(7, 5000);
  header.viseme_share = 0.5;
  header.sequence = 12;
  server.greet(header, {10, 4900, face(3)}, 1030);
  const auto events = server.events();
  ASSERT_EQ(events.size(), 3U);
  EXPECT_EQ(events[0].type, SEMBLANTE_EVENT_HEADER);
  EXPECT_EQ(events[0].resumed, SEMBLANTE_FRESH);
  EXPECT_EQ(events[0].epoch, 7U);
  EXPECT_EQ(events[0].media_time, 5000);
  EXPECT_EQ(events[1].state, static_cast<std::uint32_t>(SEMBLANTE_STREAM_OPEN));
  EXPECT_EQ(events[2].type, SEMBLANTE_EVENT_KEYFRAME);
  EXPECT_EQ(events[2].sequence, 10U);

  semblante_header known{};
  known.size = sizeof(known);
  ASSERT_EQ(semblante_stream_header(server.stream, &known), SEMBLANTE_OK);
  EXPECT_STREQ(known.stream, "stage");
  EXPECT_STREQ(known.model, "ana");
  EXPECT_EQ(known.viseme_share, 0.5);
  EXPECT_EQ(known.frame_rate, 25);
  EXPECT_EQ(known.batch_interval, 100);
  EXPECT_EQ(known.sequence, 12U);
  EXPECT_EQ(known.quantizer[3], 4);

  server.batch(5100, {{0, face(5)}, {40, face(6)}}, 1100);
  const auto more = server.events();
  ASSERT_EQ(more.size(), 1U);
  EXPECT_EQ(more[0].type, SEMBLANTE_EVENT_FRAMES);
  EXPECT_EQ(more[0].sequence, 11U);
  EXPECT_EQ(more[0].media_time, 5140);
  std::uint32_t count = 0;
  const semblante_timed_frame* frames = semblante_stream_frames(server.stream, &count);
  ASSERT_EQ(count, 2U);
  EXPECT_EQ(frames[0].time, 5100);
  EXPECT_EQ(frames[1].time, 5140);
  EXPECT_EQ(frames[1].frame.fap[3], 6 * 4);

  std::uint64_t epoch = 0;
  std::uint64_t sequence = 0;
  semblante_stream_resume_point(server.stream, &epoch, &sequence);
  EXPECT_EQ(epoch, 7U);
  EXPECT_EQ(sequence, 12U);
}

TEST(Stream, Loss_ResumesAfterAPauseThatGrows) {
  ScriptedServer server;
  server.begin(1000);
  double now = 2000;
  double before = 0;
  semblante_stream_closed(server.stream, 0, now);
  for (int attempt = 0; attempt < 8; ++attempt) {
    const double pause = semblante_stream_wake_time(server.stream) - now;
    const double whole = std::min(10'000.0, 250 * std::pow(2.0, attempt));
    EXPECT_GE(pause, whole / 2) << attempt;
    EXPECT_LE(pause, whole) << attempt;
    EXPECT_NE(pause, before) << "random";
    before = pause;
    server.events();
    now += pause;
    semblante_stream_tick(server.stream, std::nextafter(now, 0));
    EXPECT_TRUE(server.events().empty()) << "early";
    semblante_stream_tick(server.stream, now);
    EXPECT_THAT(server.types(), ElementsAre(SEMBLANTE_EVENT_STATE, SEMBLANTE_EVENT_CONNECT));
    semblante_stream_closed(server.stream, 0, now);  // refused
  }
  now = semblante_stream_wake_time(server.stream);
  semblante_stream_tick(server.stream, now);
  const Hello hello = server.open(now);
  ASSERT_TRUE(hello.resume);
  EXPECT_EQ(hello.resume->epoch, 7U);
  EXPECT_EQ(hello.resume->sequence, 10U);
  server.events();

  Header header = ScriptedServer::header(7, 9000);
  header.recovered = true;
  server.greet(header, {10, 5000, face(0)}, now);
  EXPECT_EQ(server.events()[0].resumed, SEMBLANTE_RESUMED);
  semblante_stream_closed(server.stream, 0, now);
  EXPECT_LE(semblante_stream_wake_time(server.stream) - now, 250) << "a header ends the series of attempts";
}

TEST(Stream, Resume_SaysWhetherFramesAreMissing) {
  for (const auto& [epoch, recovered, expected] :
       {std::tuple(7, true, SEMBLANTE_RESUMED), std::tuple(7, false, SEMBLANTE_RESUMED_WITH_GAP),
        std::tuple(8, false, SEMBLANTE_FRESH)}) {
    ScriptedServer server;
    server.begin(1000);
    semblante_stream_closed(server.stream, 1006, 2000);
    semblante_stream_start(server.stream, 2001);  // ends the pause
    server.open(2001);
    server.events();
    Header header = ScriptedServer::header(static_cast<std::uint64_t>(epoch), 6000);
    header.recovered = recovered;
    server.say(header, 2002);
    EXPECT_EQ(server.events()[0].resumed, expected);
    std::uint64_t known = 0;
    std::uint64_t sequence = 0;
    semblante_stream_resume_point(server.stream, &known, &sequence);
    EXPECT_EQ(known, epoch == 7 ? 7U : 0U) << "a point of another epoch is of no use";
  }
}

TEST(Stream, OptionsWithAResumePoint_AskForIt) {
  semblante_stream_options options = ScriptedServer::usual();
  options.resume_epoch = 3;
  options.resume_sequence = 44;
  ScriptedServer server(options);
  semblante_stream_start(server.stream, 0);
  EXPECT_EQ(server.open(0).resume, (ResumePoint{3, 44}));
}

TEST(Stream, Pings_AreDenseAtFirstAndGiveTheClock) {
  ScriptedServer server;
  semblante_stream_start(server.stream, 1000);
  server.open(1000);
  server.greet(ScriptedServer::header(7, 50'000), {0, 0, face(0)}, 1010);
  server.events();
  std::vector<double> times;
  double now = 1010;
  while (now < 60'000) {
    for (const Message& message : server.sent()) {
      const auto& ping = std::get<Ping>(message);
      EXPECT_EQ(ping.client_time, now);
      times.push_back(now);
      // 20 ms there and back; the stream's clock is 49000 ahead of the client's.
      server.say(Pong{ping.id, ping.client_time, 1e12 + now, static_cast<std::uint64_t>(49'000 + now)}, now + 20);
    }
    now = semblante_stream_wake_time(server.stream);
    semblante_stream_tick(server.stream, now);
  }
  EXPECT_EQ(times[1] - times[0], 200);
  EXPECT_EQ(times[4] - times[3], 200);
  EXPECT_EQ(times[6] - times[5], 1000);
  EXPECT_GE(times.back() - times[times.size() - 2], 2000);
  semblante_clock clock{};
  clock.size = sizeof(clock);
  ASSERT_EQ(semblante_stream_clock(server.stream, now, &clock), SEMBLANTE_OK);
  EXPECT_NEAR(clock.media_time, 49'000 + now, clock.uncertainty);
  EXPECT_LE(clock.uncertainty, 11.5);
  EXPECT_EQ(clock.round_trip, 20);
  EXPECT_NEAR(clock.server_offset, 1e12, 20);
  EXPECT_EQ(clock.steps, 0U);
}

TEST(Stream, NoAnswer_IsALoss) {
  ScriptedServer server;
  server.begin(1000);
  const double limit = 20'000;
  // The ping of the beginning is never answered, so this is one second after frames came last ...
  server.batch(5100, {{0, face(1)}}, 5000);
  semblante_stream_tick(server.stream, 6000);
  server.events();
  semblante_stream_tick(server.stream, 6000 + limit - 1);
  EXPECT_TRUE(server.events().empty());
  semblante_stream_tick(server.stream, 6000 + limit);
  EXPECT_THAT(server.types(), ElementsAre(SEMBLANTE_EVENT_FAULT, SEMBLANTE_EVENT_CLOSE, SEMBLANTE_EVENT_STATE));
  EXPECT_EQ(semblante_stream_get_state(server.stream), SEMBLANTE_STREAM_WAITING);

  ScriptedServer unreachable;
  semblante_stream_start(unreachable.stream, 0);
  unreachable.events();
  EXPECT_EQ(semblante_stream_wake_time(unreachable.stream), limit);
  semblante_stream_tick(unreachable.stream, limit);
  EXPECT_THAT(unreachable.types(), ElementsAre(SEMBLANTE_EVENT_FAULT, SEMBLANTE_EVENT_CLOSE, SEMBLANTE_EVENT_STATE));
}

TEST(Stream, UnreadableBytes_AreAFaultAndANewConnection) {
  const std::vector<std::vector<std::uint8_t>> hostile = {
      {}, {2}, {2, 1, 0xFF}, {128}, {9}, {9, 0xFF, 0xFF}, {9, 0}, std::vector<std::uint8_t>(300'000, 4)};
  for (const auto& bytes : hostile) {
    ScriptedServer server;
    server.begin(1000);
    server.say_bytes(bytes, 1100);
    const auto events = server.events();
    ASSERT_EQ(events.size(), 3U);
    EXPECT_EQ(events[0].type, SEMBLANTE_EVENT_FAULT);
    EXPECT_NE(events[0].error.message[0], '\0');
    EXPECT_EQ(events[1].type, SEMBLANTE_EVENT_CLOSE);
    EXPECT_EQ(events[1].code, 4000U);
    EXPECT_EQ(events[2].state, static_cast<std::uint32_t>(SEMBLANTE_STREAM_WAITING));
    server.say_bytes(bytes, 1200);
    EXPECT_TRUE(server.events().empty()) << "of a connection that was given up";
  }
}

TEST(Stream, FramesBeforeTheHeader_AreAFault) {
  ScriptedServer server;
  semblante_stream_start(server.stream, 0);
  server.open(0);
  server.events();
  server.say_bytes(PackedEncoder({1, 2, face(3)}).keyframe(), 1);
  EXPECT_EQ(server.events()[0].type, SEMBLANTE_EVENT_FAULT);
}

TEST(Stream, MessagesOfALaterVersion_AreSkipped) {
  ScriptedServer server;
  server.begin(1000);
  server.say_bytes({60, 1, 2, 3}, 1100);
  EXPECT_TRUE(server.events().empty());

  ScriptedServer later;
  semblante_stream_start(later.stream, 0);
  later.open(0);
  later.events();
  Header header = ScriptedServer::header(1, 1);
  header.version = protocol_version + 1;
  later.say(header, 1);
  const auto events = later.events();
  EXPECT_EQ(events[0].type, SEMBLANTE_EVENT_FAULT);
  EXPECT_EQ(events[0].code, static_cast<std::uint32_t>(SEMBLANTE_UNSUPPORTED));
  EXPECT_EQ(semblante_stream_get_state(later.stream), SEMBLANTE_STREAM_CLOSED) << "another connection begins so too";
}

TEST(Stream, End_IsFinalForSomeReasons) {
  for (const EndReason reason : {EndReason::other, EndReason::finished, EndReason::deleted, EndReason::shutdown,
                                 EndReason::replaced, EndReason::slow}) {
    const bool is_final =
        reason == EndReason::finished || reason == EndReason::deleted || reason == EndReason::replaced;
    ScriptedServer server;
    server.begin(1000);
    server.say(End{reason}, 1100);
    const auto events = server.events();
    EXPECT_EQ(events[0].type, SEMBLANTE_EVENT_END);
    EXPECT_EQ(events[0].code, static_cast<std::uint32_t>(reason));
    EXPECT_EQ(events[0].is_final != 0, is_final);
    server.batch(5200, {{0, face(1)}}, 1101);
    EXPECT_TRUE(server.events().empty()) << "after the end";
    semblante_stream_closed(server.stream, 1000, 1102);
    EXPECT_EQ(semblante_stream_get_state(server.stream), is_final ? SEMBLANTE_STREAM_CLOSED : SEMBLANTE_STREAM_WAITING);
  }
}

TEST(Stream, Stop_ClosesAndStartGoesOn) {
  ScriptedServer server;
  server.begin(1000);
  semblante_stream_stop(server.stream, 1500);
  const auto events = server.events();
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].type, SEMBLANTE_EVENT_CLOSE);
  EXPECT_EQ(events[0].code, 1000U);
  EXPECT_EQ(semblante_stream_wake_time(server.stream), std::numeric_limits<double>::infinity());
  semblante_stream_tick(server.stream, 1e6);
  EXPECT_TRUE(server.events().empty());
  semblante_stream_start(server.stream, 1e6);
  EXPECT_EQ(server.open(1e6).resume, (ResumePoint{7, 10}));
}

TEST(Stream, EventsThatNobodyTakes_AreBoundedAndKeepWhatMatters) {
  ScriptedServer server;
  server.begin(1000);
  for (std::uint64_t i = 0; i < 500; ++i) server.batch(5100 + 40 * i, {{0, face(static_cast<int>(i % 50))}}, 1100);
  semblante_stream_closed(server.stream, 0, 1200);
  for (std::uint64_t i = 0; i < 3; ++i) semblante_stream_tick(server.stream, semblante_stream_wake_time(server.stream));
  const auto types = server.types();
  EXPECT_EQ(types.size(), 64U);
  EXPECT_THAT(types, ::testing::Contains(SEMBLANTE_EVENT_CONNECT));
}

semblante_stream_options publisher() {
  semblante_stream_options options = ScriptedServer::usual();
  options.role = SEMBLANTE_ROLE_PUBLISH;
  options.take_over = 1;
  return options;
}

void greet_publisher(ScriptedServer& server, double now) {
  const Hello hello = server.open(now);
  EXPECT_EQ(hello.role, StreamRole::publish);
  EXPECT_TRUE(hello.take_over);
  server.say(ScriptedServer::header(7, 5000), now);
  server.events();
  server.sent();  // a ping
}

TEST(Publisher, FirstIsAKeyframe_AndAgainAfterARefusalAndALoss) {
  ScriptedServer server(publisher());
  const semblante_timed_frame frame = jaw_at(0, 100);
  EXPECT_EQ(semblante_stream_publish(server.stream, &frame, 1, 0, 0), SEMBLANTE_UNAVAILABLE);
  semblante_stream_start(server.stream, 0);
  greet_publisher(server, 0);

  const semblante_timed_frame two[] = {jaw_at(0, 100), jaw_at(40, 200)};
  ASSERT_EQ(semblante_stream_publish(server.stream, two, 2, 1000, 10), SEMBLANTE_OK);
  auto sent = server.sent();
  ASSERT_EQ(sent.size(), 2U);
  EXPECT_EQ(std::get<Keyframe>(sent[0]).media_time, 1000U);
  EXPECT_EQ(std::get<Keyframe>(sent[0]).state, face(25));
  const auto& frames = std::get<Frames>(sent[1]);
  ASSERT_EQ(frames.frames.size(), 1U);
  EXPECT_EQ(frames.media_time + frames.frames[0].time, 1040U);
  EXPECT_EQ(frames.frames[0].state, face(50));

  ASSERT_EQ(semblante_stream_publish(server.stream, &frame, 1, 1080, 20), SEMBLANTE_OK);
  EXPECT_NE(only<Frames>(server.sent()), nullptr);

  server.say(StreamError{StreamErrorCode::mismatch, "/sequence", "no"}, 30);
  const auto events = server.events();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].type, SEMBLANTE_EVENT_REFUSED);
  EXPECT_EQ(events[0].code, static_cast<std::uint32_t>(SEMBLANTE_REFUSED_MISMATCH));
  EXPECT_STREQ(events[0].error.where, "/sequence");
  ASSERT_EQ(semblante_stream_publish(server.stream, &frame, 1, 1120, 40), SEMBLANTE_OK);
  EXPECT_NE(only<Keyframe>(server.sent()), nullptr) << "the server may not have the frame before";

  semblante_stream_closed(server.stream, 0, 50);
  EXPECT_EQ(semblante_stream_publish(server.stream, &frame, 1, 1160, 60), SEMBLANTE_UNAVAILABLE);
  semblante_stream_start(server.stream, 70);
  greet_publisher(server, 70);
  ASSERT_EQ(semblante_stream_publish(server.stream, &frame, 1, 1200, 80), SEMBLANTE_OK);
  EXPECT_NE(only<Keyframe>(server.sent()), nullptr);
}

TEST(Publisher, Batch_TravelsInOneMessage) {
  semblante_stream_options options = publisher();
  options.batch = 100;
  ScriptedServer server(options);
  semblante_stream_start(server.stream, 0);
  greet_publisher(server, 0);
  semblante_timed_frame frame = jaw_at(0, 4);
  ASSERT_EQ(semblante_stream_publish(server.stream, &frame, 1, 500, 10), SEMBLANTE_OK);
  EXPECT_TRUE(server.sent().empty());
  EXPECT_EQ(semblante_stream_wake_time(server.stream), 110);
  for (int i = 1; i <= 3; ++i) {
    frame = jaw_at(0, static_cast<float>(4 + 4 * i));
    ASSERT_EQ(semblante_stream_publish(server.stream, &frame, 1, 500 + 20 * i, 10 + 20 * i), SEMBLANTE_OK);
  }
  semblante_stream_tick(server.stream, 110);
  const auto sent = server.sent();
  ASSERT_EQ(sent.size(), 2U) << "the first message of a connection is a keyframe";
  const auto& frames = std::get<Frames>(sent[1]);
  ASSERT_EQ(frames.frames.size(), 3U);
  EXPECT_EQ(frames.media_time + frames.frames[2].time, 560U);
  EXPECT_EQ(frames.frames[2].state, face(4));
}

TEST(Publisher, WhatCannotBePublished_IsRefusedHere) {
  ScriptedServer server(publisher());
  semblante_stream_start(server.stream, 0);
  greet_publisher(server, 0);
  const auto publish = [&](const semblante_timed_frame& frame, std::uint32_t count = 1, double media_time = 1) {
    return semblante_stream_publish(server.stream, &frame, count, media_time, 1);
  };
  EXPECT_EQ(publish(jaw_at(0, 1), 0), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(publish(jaw_at(0, std::numeric_limits<float>::infinity())), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(publish(jaw_at(std::nan(""), 1)), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(publish(jaw_at(-1, 1)), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(publish(jaw_at(10'001, 1)), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(publish(jaw_at(0, 1), 1, -1), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(publish(jaw_at(0, 1), 1, std::nan("")), SEMBLANTE_INVALID_ARGUMENT);
  semblante_timed_frame frame = jaw_at(0, 1);
  frame.frame.viseme1 = 15;
  EXPECT_EQ(publish(frame), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_TRUE(server.sent().empty());
  EXPECT_EQ(publish(jaw_at(0, 1e9F)), SEMBLANTE_OK) << "clamped to the largest level";

  ScriptedServer subscriber;
  subscriber.begin(0);
  frame = jaw_at(0, 1);
  EXPECT_EQ(semblante_stream_publish(subscriber.stream, &frame, 1, 1, 1), SEMBLANTE_INVALID_ARGUMENT);
}

TEST(Publisher, NobodyTakesTheBytes_IsRefusedBeyondALimit) {
  ScriptedServer server(publisher());
  semblante_stream_start(server.stream, 0);
  greet_publisher(server, 0);
  std::mt19937 random(1);
  int published = 0;
  semblante_timed_frame frame{};
  for (; published < 100'000; ++published) {
    for (std::size_t fap = 3; fap < 69; ++fap) frame.frame.fap[fap] = static_cast<float>(random() % 1000);
    const auto result = semblante_stream_publish(server.stream, &frame, 1, 1000 + published, 1);
    if (result == SEMBLANTE_UNAVAILABLE) break;
    ASSERT_EQ(result, SEMBLANTE_OK);
  }
  EXPECT_GT(published, 1000);
  EXPECT_LT(published, 20'000);
  EXPECT_EQ(server.sent().size(), static_cast<std::size_t>(published)) << "what was accepted is whole";
}

TEST(Stream, WrongArguments_AreRefusedOrIgnored) {
  semblante_stream* stream = nullptr;
  semblante_stream_options options{};
  semblante_error error{};
  EXPECT_EQ(semblante_stream_create(&options, &stream, &error), SEMBLANTE_INVALID_ARGUMENT) << "no size";
  EXPECT_EQ(semblante_stream_create(nullptr, nullptr, nullptr), SEMBLANTE_INVALID_ARGUMENT);
  options.size = sizeof(options);
  options.batch = std::nan("");
  EXPECT_EQ(semblante_stream_create(&options, &stream, &error), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_STREQ(error.where, "options");
  options = {};
  options.size = 8;  // an older caller, who knows `role` only
  options.role = SEMBLANTE_ROLE_PUBLISH;
  options.batch = std::nan("");
  ASSERT_EQ(semblante_stream_create(&options, &stream, &error), SEMBLANTE_OK);
  semblante_stream_start(stream, std::nan(""));
  EXPECT_EQ(semblante_stream_get_state(stream), SEMBLANTE_STREAM_CLOSED);
  EXPECT_EQ(semblante_stream_receive(stream, nullptr, 3, 0), SEMBLANTE_INVALID_ARGUMENT);
  semblante_stream_start(stream, 0);
  struct {
    semblante_event event;
    std::uint8_t behind;
  } small;
  std::memset(&small, 0xAB, sizeof(small));
  small.event.size = 12;  // size, type, state
  ASSERT_EQ(semblante_stream_next_event(stream, &small.event), 1U);
  EXPECT_EQ(small.event.size, 12U);
  EXPECT_EQ(small.event.type, SEMBLANTE_EVENT_STATE);
  EXPECT_EQ(small.event.code, 0xABABABABU) << "beyond the caller's size";
  semblante_stream_destroy(stream);

  semblante_stream_start(nullptr, 0);
  semblante_stream_tick(nullptr, 0);
  semblante_stream_destroy(nullptr);
  EXPECT_EQ(semblante_stream_take_bytes(nullptr, nullptr), nullptr);
}

/// Anything at any time: no crash, and bounded (sanitizers and the fuzz target look closer).
TEST(Stream, RandomMessagesAndCalls_AreSurvived) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 300; ++round) {
    ScriptedServer server(round % 2 == 0 ? ScriptedServer::usual() : publisher());
    double now = 0;
    semblante_stream_start(server.stream, now);
    for (int step = 0; step < 60; ++step) {
      now += static_cast<double>(random() % 3000);
      switch (random() % 8) {
        case 0:
          semblante_stream_opened(server.stream, now);
          break;
        case 1:
          server.say(ScriptedServer::header(random() % 3, random() % 100'000), now);
          break;
        case 2:
          server.say_bytes(
              PackedEncoder({random() % 9, random() % 9000, face(static_cast<int>(random() % 9))}).keyframe(), now);
          break;
        case 3: {
          std::vector<std::uint8_t> bytes(random() % 40);
          for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
          if (!bytes.empty() && random() % 2 == 0) bytes[0] = static_cast<std::uint8_t>(1 + random() % 9);
          server.say_bytes(bytes, now);
          break;
        }
        case 4:
          semblante_stream_closed(server.stream, 0, now);
          break;
        case 5:
          semblante_stream_start(server.stream, now);
          break;
        default:
          semblante_stream_tick(server.stream, now);
          break;
      }
      std::size_t size = 0;
      while (semblante_stream_take_bytes(server.stream, &size) != nullptr) {
      }
      EXPECT_LE(server.events().size(), 64U);
    }
  }
}

}  // namespace
}  // namespace semblante::testing

#include <gtest/gtest.h>

#include "protocol/cpp/json_codec.h"
#include "server/streams/batch_sender.h"
#include "server/streams/growing_source.h"
#include "server/streams/player.h"
#include "server/streams/stream.h"
#include "server/streams/stream_header.h"
#include "tests/unit/streams/fake_socket.h"
#include "tests/unit/streams/feeding.h"

/// The sound of a stream: who gets it, when, and what a slow listener loses.
namespace semblante::streams {
namespace {

using std::chrono::milliseconds;
using Bytes = std::vector<std::uint8_t>;

const Bytes packet = {0x18, 1, 2, 3};

std::vector<SoundPacket> sounds_of(const std::vector<Message>& messages) {
  std::vector<SoundPacket> sounds;
  for (const auto& message : messages)
    if (const auto* sound = std::get_if<SoundPacket>(&message)) sounds.push_back(*sound);
  return sounds;
}

std::size_t count_frames(const std::vector<Message>& messages) {
  std::size_t count = 0;
  for (const auto& message : messages)
    if (const auto* frames = std::get_if<Frames>(&message)) count += frames->frames.size();
  return count;
}

class SoundTest : public ::testing::Test {
 protected:
  SoundTest() {
    limits_.pending_messages = 4;
    stream_ = std::make_shared<Stream>(unbatched_stream(), limits_);
    const auto ticket = stream_->begin_playing(25.0, false);
    EXPECT_TRUE(ticket);
    ticket_ = ticket ? *ticket : 0;
    began_ = Stream::Clock::now();
  }
  std::shared_ptr<FakeClient> connect(bool sound) {
    return std::make_shared<FakeClient>(stream_, StreamRole::subscribe, sound);
  }
  void sound(int ms) { stream_->play_sound(ticket_, began_ + milliseconds(ms), packet); }
  void frame(int ms, std::int16_t level) {
    EXPECT_TRUE(stream_->publish_playing(ticket_, began_ + milliseconds(ms), frame_with(level)));
  }

  StreamLimits limits_;
  std::shared_ptr<Stream> stream_;
  Stream::Ticket ticket_ = 0;
  Stream::Clock::time_point began_;  ///< after the stream's own beginning
};

TEST_F(SoundTest, Header_NamesTheSoundForThoseWhoAsk) {
  const auto listener = connect(true)->take_all();
  const auto viewer = connect(false)->take_all();
  ASSERT_FALSE(listener.empty());
  ASSERT_FALSE(viewer.empty());
  EXPECT_EQ(std::get<Header>(listener[0]).sound, stream_sound);
  EXPECT_EQ(std::get<Header>(viewer[0]).sound, std::nullopt);
}

TEST_F(SoundTest, Sound_GoesToListenersOnly) {
  const auto listener = connect(true);
  const auto viewer = connect(false);
  listener->take_all();
  viewer->take_all();
  sound(0);
  frame(0, 5);
  sound(60);
  const auto heard = listener->take_all();
  const auto sounds = sounds_of(heard);
  ASSERT_EQ(sounds.size(), 2U);
  EXPECT_EQ(sounds[0].packet, packet);
  EXPECT_EQ(sounds[1].media_time - sounds[0].media_time, 60U) << "on the clock of the frames";
  EXPECT_EQ(count_frames(heard), 1U);
  ASSERT_TRUE(std::holds_alternative<Frames>(heard[1]));
  EXPECT_EQ(std::get<Frames>(heard[1]).media_time, sounds[0].media_time);
  EXPECT_EQ(viewer->take_all().size(), 1U) << "the frame alone";
  EXPECT_EQ(stream_->counts().sound_packets, 2U);
  EXPECT_EQ(stream_->counts().sound_sent, 2U);
}

TEST_F(SoundTest, Viewer_GetsTheSameBytesAsWithoutSound) {
  const auto listener = connect(true);
  const auto viewer = connect(false);
  viewer->take_all();
  frame(0, 5);
  const auto before = viewer->socket->take_payloads();
  sound(20);
  frame(40, 5);
  const auto after = viewer->socket->take_payloads();
  ASSERT_EQ(before.size(), 1U);
  ASSERT_EQ(after.size(), 1U);
}

TEST_F(SoundTest, LateListener_HearsFromNowOn) {
  const auto first = connect(true);
  first->take_all();
  sound(0);
  const auto late = connect(true);
  EXPECT_TRUE(sounds_of(late->take_all()).empty());
  sound(60);
  EXPECT_EQ(sounds_of(late->take_all()).size(), 1U);
}

TEST_F(SoundTest, SlowListener_LosesSoundBeforeFrames) {
  const auto slow = connect(true);
  slow->take_all();
  slow->socket->stop_reading();
  for (int k = 0; k < 4; ++k) {
    frame(60 * k, static_cast<std::int16_t>(k + 1));
    sound(60 * k);
  }
  EXPECT_EQ(slow->socket->waiting(), 4U) << "the four frames that the limit allows";
  EXPECT_EQ(stream_->counts().sound_dropped, 4U);
  EXPECT_EQ(stream_->counts().messages_replaced, 0U);
  slow->socket->read_again(*slow->connection);
  auto messages = slow->take_all();
  EXPECT_EQ(count_frames(messages), 4U);
  EXPECT_TRUE(sounds_of(messages).empty());
  sound(300);
  EXPECT_EQ(sounds_of(slow->take_all()).size(), 1U) << "it hears again as soon as it reads again";
}

TEST_F(SoundTest, SoundThatWaits_DoesNotPutAListenerBehind) {
  const auto slow = connect(true);
  slow->take_all();
  slow->socket->stop_reading();
  for (int k = 0; k < 50; ++k) sound(60 * k);
  EXPECT_EQ(slow->socket->waiting(), 1U) << "one packet, which found the socket idle";
  frame(3000, 7);
  slow->socket->read_again(*slow->connection);
  EXPECT_EQ(count_frames(slow->take_all()), 1U) << "the frame itself, no keyframe in its place";
  EXPECT_EQ(stream_->counts().messages_replaced, 0U);
}

/// A machine with much else to do: the thread that sends does not run for a while.
TEST_F(SoundTest, PacketsThatWaitWithFrames_AreSentLater) {
  const auto sender = std::make_shared<BatchSender>();
  sender->stop();
  stream_ = std::make_shared<Stream>(unbatched_stream(), limits_, sender);
  const auto ticket = stream_->begin_playing(25.0, false);
  ASSERT_TRUE(ticket);
  ticket_ = *ticket;
  const auto listener = connect(true);
  listener->take_all();
  for (int k = 0; k < 20; ++k) {
    frame(60 * k, static_cast<std::int16_t>(k + 1));
    sound(60 * k);
  }
  const auto now = Stream::Clock::now();
  for (int k = 0; k < 100; ++k) stream_->advance(now + milliseconds(k));
  const auto messages = listener->take_all();
  EXPECT_EQ(count_frames(messages), 20U) << "in fewer batches";
  EXPECT_EQ(sounds_of(messages).size(), 16U);
  EXPECT_EQ(stream_->counts().sound_dropped, 4U);
}

TEST_F(SoundTest, NobodyListens_NothingIsQueued) {
  const auto viewer = connect(false);
  viewer->take_all();
  for (int k = 0; k < 50; ++k) sound(60 * k);
  EXPECT_TRUE(viewer->take_all().empty());
  EXPECT_EQ(stream_->counts().sound_packets, 50U);
  EXPECT_EQ(stream_->counts().sound_dropped, 0U);
}

TEST_F(SoundTest, ListenerThatLeaves_IsNotCounted) {
  const auto listener = connect(true);
  listener->take_all();
  listener->leave();
  sound(0);
  EXPECT_EQ(stream_->counts().sound_sent + stream_->counts().sound_dropped, 0U);
}

TEST_F(SoundTest, ReplacedSource_IsHeardNoMore) {
  const auto listener = connect(true);
  listener->take_all();
  ASSERT_TRUE(stream_->begin_playing(25.0, true));
  sound(0);
  EXPECT_TRUE(sounds_of(listener->take_all()).empty());
}

TEST_F(SoundTest, SoundOfASubscriber_IsRefused) {
  const auto client = connect(true);
  client->take_all();
  client->connection->receive(encode_json(Message(SoundPacket{1, packet})), false);
  const auto answers = client->take_all();
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(std::get<StreamError>(answers[0]).code, StreamErrorCode::invalid_argument);
}

const Bytes packet_of_20_ms = {0x08, 1, 2, 3};

/// A publisher with sound, and one who listens.
class PublishedSoundTest : public ::testing::Test {
 protected:
  PublishedSoundTest() {
    listener_->take_all();
    publisher_->take_all();
  }
  std::shared_ptr<FakeClient> connect(StreamRole role, bool sound = true) {
    return std::make_shared<FakeClient>(stream_, role, sound);
  }
  void send(const Message& message) { publisher_->connection->receive(encode_json(message), false); }
  void frame(std::uint64_t media_time) { send(Frames{0, media_time, {frame_with(5)}}); }
  void sound(std::uint64_t media_time, const Bytes& bytes = packet_of_20_ms) { send(SoundPacket{media_time, bytes}); }
  /// The code of the only answer to the publisher.
  StreamErrorCode refusal() {
    const auto answers = publisher_->take_all();
    EXPECT_EQ(answers.size(), 1U);
    if (answers.empty() || !std::holds_alternative<StreamError>(answers[0])) return StreamErrorCode::other;
    return std::get<StreamError>(answers[0]).code;
  }

  std::shared_ptr<Stream> stream_ = std::make_shared<Stream>(unbatched_stream(), StreamLimits{});
  std::shared_ptr<FakeClient> listener_ = connect(StreamRole::subscribe);
  std::shared_ptr<FakeClient> publisher_ = connect(StreamRole::publish);
};

TEST_F(PublishedSoundTest, Header_NamesTheSoundForThoseWhoSendIt) {
  publisher_->leave();
  const auto answers = connect(StreamRole::publish)->take_all();
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(std::get<Header>(answers[0]).sound, stream_sound);
}

TEST_F(PublishedSoundTest, SoundAndFrames_AreOnOneClock) {
  constexpr std::uint64_t begin = 5'000'000;  // by the publisher's clock
  frame(begin);
  sound(begin + 20);
  sound(begin + 40);
  const auto heard = listener_->take_all();
  const auto sounds = sounds_of(heard);
  ASSERT_EQ(sounds.size(), 2U);
  EXPECT_EQ(sounds[0].packet, packet_of_20_ms);
  ASSERT_TRUE(std::holds_alternative<Frames>(heard[0]));
  EXPECT_EQ(sounds[0].media_time - std::get<Frames>(heard[0]).media_time, 20U);
  EXPECT_EQ(sounds[1].media_time - sounds[0].media_time, 20U);
  EXPECT_TRUE(publisher_->take_all().empty()) << "nothing was refused";
  EXPECT_EQ(stream_->counts().sound_packets, 2U);
}

TEST_F(PublishedSoundTest, SoundAloneBegins_AndFramesFollowOnItsClock) {
  sound(5000);
  frame(5010);
  const auto heard = listener_->take_all();
  ASSERT_EQ(heard.size(), 2U);
  EXPECT_EQ(std::get<Frames>(heard[1]).media_time - std::get<SoundPacket>(heard[0]).media_time, 10U);
}

TEST_F(PublishedSoundTest, PacketsThatOverlap_AreRefused) {
  sound(5000);
  sound(5019);
  EXPECT_EQ(refusal(), StreamErrorCode::out_of_range);
  sound(5020);
  EXPECT_EQ(sounds_of(listener_->take_all()).size(), 2U);
}

TEST_F(PublishedSoundTest, PacketsOfHalfMilliseconds_FollowEachOther) {
  const Bytes short_packet = {0x80, 1};  // 2.5 ms
  for (const std::uint64_t at : {5000, 5002, 5005, 5007, 5010}) sound(at, short_packet);
  EXPECT_TRUE(publisher_->take_all().empty());
  EXPECT_EQ(sounds_of(listener_->take_all()).size(), 5U);
}

TEST_F(PublishedSoundTest, WithoutAHelloThatSaysSo_IsRefused) {
  publisher_->leave();
  publisher_ = connect(StreamRole::publish, false);
  publisher_->take_all();
  sound(5000);
  EXPECT_EQ(refusal(), StreamErrorCode::invalid_argument);
  EXPECT_TRUE(sounds_of(listener_->take_all()).empty());
}

TEST_F(PublishedSoundTest, ReplacedPublisher_IsHeardNoMore) {
  sound(5000);
  ASSERT_TRUE(stream_->begin_playing(25.0, true));
  sound(5020);
  EXPECT_EQ(sounds_of(listener_->take_all()).size(), 1U);
}

TEST_F(PublishedSoundTest, NextPublisher_IsHeardWhenTheSoundBeforeItHasEnded) {
  sound(5000);
  sound(6000);  // a second ahead
  publisher_->leave();
  publisher_ = connect(StreamRole::publish);
  publisher_->take_all();
  sound(90'000);
  sound(91'100);
  EXPECT_TRUE(publisher_->take_all().empty()) << "it did nothing wrong";
  const auto sounds = sounds_of(listener_->take_all());
  ASSERT_EQ(sounds.size(), 3U);
  EXPECT_GE(sounds[2].media_time, sounds[1].media_time + 20);
}

TEST_F(PublishedSoundTest, MoreBytesThanOpusHas_AreThrottled) {
  const Bytes large(4000, 0x08);
  std::uint64_t at = 5000;
  std::vector<Message> answers;
  for (; answers.empty(); at += 20) {  // 256000 bytes, and what the time of this test allows
    ASSERT_LT(at, 50'000U);
    sound(at, large);
    answers = publisher_->take_all();
  }
  EXPECT_GE(sounds_of(listener_->take_all()).size(), 64U);
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(std::get<StreamError>(answers[0]).code, StreamErrorCode::throttled);
}

// Packets that overlap are small: even a slow machine sends more of them than may be refused in a second.
TEST_F(PublishedSoundTest, TooManyRefusedPackets_CloseTheConnection) {
  sound(5000);
  for (int k = 0; k < 10'000 && !publisher_->socket->closed(); ++k) sound(5000);
  ASSERT_TRUE(publisher_->socket->closed());
  EXPECT_EQ(publisher_->socket->closed()->code, 1008);
}

/// 400 ms, with three packets of 60 ms, the second of which is silent.
std::shared_ptr<const FrameSource> speaking() {
  auto source = std::make_shared<GrowingSource>(standard_quantizers());
  EXPECT_TRUE(source->add_part({}, 0.0, 400.0));
  EXPECT_TRUE(source->add_sound({{0, packet}, {120, packet}}));
  source->finish();
  return source;
}

class SoundPlayerTest : public SoundTest {
 protected:
  Player player(double from) {
    PlayOptions options;
    options.from = from;
    return {"1", stream_, ticket_, speaking(), options, began_};
  }
};

TEST_F(SoundPlayerTest, Packets_AreSentWhenTheyAreDue) {
  const auto listener = connect(true);
  listener->take_all();
  auto plays = player(0.0);
  plays.play(began_);
  EXPECT_EQ(sounds_of(listener->take_all()).size(), 1U);
  for (int ms = 40; ms < 120; ms += 40) plays.play(began_ + milliseconds(ms));
  EXPECT_TRUE(sounds_of(listener->take_all()).empty()) << "nothing is sent for silence";
  EXPECT_EQ(plays.next(), began_ + milliseconds(120));
  plays.play(began_ + milliseconds(120));
  const auto heard = listener->take_all();
  ASSERT_EQ(sounds_of(heard).size(), 1U);
  ASSERT_TRUE(std::holds_alternative<SoundPacket>(heard[0])) << "before the frame of its time";
  EXPECT_EQ(std::get<Frames>(heard[1]).media_time, std::get<SoundPacket>(heard[0]).media_time);
}

TEST_F(SoundPlayerTest, LatePlayer_LeavesOutWhatIsOver) {
  const auto listener = connect(true);
  listener->take_all();
  auto plays = player(0.0);
  plays.play(began_ + milliseconds(250));
  const auto sounds = sounds_of(listener->take_all());
  ASSERT_EQ(sounds.size(), 1U) << "the packet of 120 ms, not that of 0";
}

TEST_F(SoundPlayerTest, PlayFromLater_HearsFromThere) {
  const auto listener = connect(true);
  listener->take_all();
  auto plays = player(100.0);
  plays.play(began_);
  EXPECT_TRUE(sounds_of(listener->take_all()).empty());
  plays.play(began_ + milliseconds(20));
  EXPECT_EQ(sounds_of(listener->take_all()).size(), 1U);
}

}  // namespace
}  // namespace semblante::streams

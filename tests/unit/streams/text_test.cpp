#include <thread>

#include <gtest/gtest.h>

#include "protocol/cpp/json_codec.h"
#include "server/streams/growing_source.h"
#include "server/streams/player.h"
#include "server/streams/stream.h"
#include "tests/unit/streams/fake_socket.h"
#include "tests/unit/streams/feeding.h"

/// Speech as text, for clients with a voice of their own and for captions: who gets it, what they do not get, and how
/// they come back.
namespace semblante::streams {
namespace {

using std::chrono::milliseconds;

/// Two words, 480 ms.
SpeechText sentence(std::uint64_t ms = 0) { return {0, ms, "en", "Good day", {0x9f, 0x9f}}; }

template <class M>
std::vector<M> all_of(const std::vector<Message>& messages) {
  std::vector<M> found;
  for (const auto& message : messages)
    if (const auto* one = std::get_if<M>(&message)) found.push_back(*one);
  return found;
}

class TextTest : public ::testing::Test {
 protected:
  TextTest() {
    limits_.pending_messages = 4;
    stream_ = std::make_shared<Stream>(unbatched_stream(), limits_);
    const auto ticket = stream_->begin_playing(25.0, false);
    EXPECT_TRUE(ticket);
    ticket_ = ticket ? *ticket : 0;
    began_ = Stream::Clock::now();
  }
  std::shared_ptr<FakeClient> connect(Hello hello) {
    auto client = std::make_shared<FakeClient>(stream_);
    client->connection->receive(encode_json(Message(hello)), false);
    return client;
  }
  /// One whose beginning is taken already.
  std::shared_ptr<FakeClient> reader(bool sound = false) {
    Hello hello;
    hello.sound = sound;
    hello.text = true;
    auto client = connect(hello);
    client->take_all();
    return client;
  }
  void text(int ms = 0) { stream_->publish_text(ticket_, began_ + milliseconds(ms), sentence()); }
  void frame(int ms, std::int16_t level) {
    EXPECT_TRUE(stream_->publish_playing(ticket_, began_ + milliseconds(ms), frame_with(level)));
  }
  static void say(FakeClient& client, const Spoken& spoken) {
    client.connection->receive(encode_json(Message(spoken)), false);
  }

  StreamLimits limits_;
  std::shared_ptr<Stream> stream_;
  Stream::Ticket ticket_ = 0;
  Stream::Clock::time_point began_;  ///< after the stream's own beginning
};

TEST_F(TextTest, Reader_GetsTextInPlaceOfFramesAndSound) {
  const auto reads = reader(true);
  text();
  frame(0, 5);
  stream_->play_sound(ticket_, began_, {0x18, 1});
  const auto got = reads->take_all();
  ASSERT_EQ(got.size(), 1U);
  const auto& said = std::get<SpeechText>(got[0]);
  EXPECT_EQ(said.speech, 1U);
  EXPECT_EQ(said.text, "Good day");
  EXPECT_EQ(said.language, "en");
  EXPECT_EQ(said.score, sentence().score);
  EXPECT_EQ(stream_->counts().texts_sent, 1U);
}

TEST_F(TextTest, OthersGetTheSameBytesAsWithoutText) {
  const auto reads = reader();
  const auto viewer = connect({});
  viewer->socket->take_payloads();
  frame(0, 5);
  const auto before = viewer->socket->take_payloads();
  text();
  frame(40, 5);
  stream_->end_playing(ticket_, false);
  const auto after = viewer->socket->take_payloads();
  EXPECT_EQ(before.size(), 1U);
  EXPECT_EQ(after.size(), 1U) << "the second frame alone";
}

TEST_F(TextTest, Frames_ThatAreNoSpeech_ComeToReadersToo) {
  const auto reads = reader();
  frame(0, 5);
  EXPECT_EQ(all_of<Frames>(reads->take_all()).size(), 1U);
}

TEST_F(TextTest, AfterTheSpeech_ReadersGetTheNewestStateAndGoOn) {
  const auto reads = reader();
  text();
  frame(0, 5);
  frame(40, 6);
  reads->take_all();
  stream_->end_playing(ticket_, false);
  const auto got = reads->take_all();
  const auto hush = all_of<SpeechText>(got);
  ASSERT_EQ(hush.size(), 1U) << "half a second of text was not over";
  EXPECT_EQ(hush[0].text, "");
  EXPECT_EQ(hush[0].speech, 2U);
  const auto keys = all_of<Keyframe>(got);
  ASSERT_EQ(keys.size(), 1U);
  EXPECT_EQ(keys[0].state.level[3], 6);
  ASSERT_TRUE(stream_->publish_request({frame_with(7)}));
  const auto frames = all_of<Frames>(reads->take_all());
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].frames[0].state.level[3], 7);
}

TEST_F(TextTest, TextThatIsOver_IsNotHushed) {
  const auto reads = reader();
  text(-400);  // it is over 80 ms from now
  std::this_thread::sleep_for(milliseconds(100));
  reads->take_all();
  stream_->end_playing(ticket_, false);
  EXPECT_TRUE(all_of<SpeechText>(reads->take_all()).empty());
}

TEST_F(TextTest, StoppedAndReplacedSpeech_IsHushed) {
  const auto reads = reader();
  text();
  reads->take_all();
  ASSERT_TRUE(stream_->begin_playing(25.0, true));
  while (stream_->advance(Stream::Clock::now()) <= Stream::Clock::now()) continue;
  const auto hush = all_of<SpeechText>(reads->take_all());
  ASSERT_EQ(hush.size(), 1U);
  EXPECT_EQ(hush[0].text, "");
  text();
  EXPECT_TRUE(reads->take_all().empty()) << "it speaks no more";
}

TEST_F(TextTest, LateReader_GetsWhatIsBeingSaid) {
  text();
  text(2000);
  frame(0, 5);
  Hello hello;
  hello.text = true;
  const auto late = connect(hello);
  const auto got = late->take_all();
  ASSERT_EQ(got.size(), 4U);
  EXPECT_TRUE(std::holds_alternative<Header>(got[0]));
  EXPECT_TRUE(std::holds_alternative<Keyframe>(got[1]));
  EXPECT_EQ(std::get<SpeechText>(got[2]).speech, 1U);
  EXPECT_EQ(std::get<SpeechText>(got[3]).speech, 2U);
  frame(40, 6);
  EXPECT_TRUE(late->take_all().empty());
}

TEST_F(TextTest, Resume_DuringASpeech_BringsTheTextAgainAndNoGap) {
  const auto reads = reader();
  frame(0, 1);
  reads->take_all();
  text();
  for (int k = 1; k < 5; ++k) frame(40 * k, 5);
  Hello hello;
  hello.text = true;
  hello.resume = ResumePoint{7, 1};
  const auto back = connect(hello);
  const auto got = back->take_all();
  ASSERT_EQ(got.size(), 3U);
  EXPECT_FALSE(std::get<Header>(got[0]).recovered);
  EXPECT_EQ(std::get<Keyframe>(got[1]).state.level[3], 5);
  EXPECT_EQ(std::get<SpeechText>(got[2]).speech, 1U) << "the number that it knows";
}

TEST_F(TextTest, VoiceThatFails_BringsFramesAtOnce) {
  const auto reads = reader(true);
  text();
  frame(0, 5);
  reads->take_all();
  say(*reads, {VoiceState::failed, 1, 0, 0});
  const auto keys = all_of<Keyframe>(reads->take_all());
  ASSERT_EQ(keys.size(), 1U);
  EXPECT_EQ(keys[0].state.level[3], 5);
  frame(40, 6);
  stream_->play_sound(ticket_, began_ + milliseconds(40), {0x18, 1});
  const auto got = reads->take_all();
  EXPECT_EQ(all_of<Frames>(got).size(), 1U);
  EXPECT_EQ(all_of<SoundPacket>(got).size(), 1U) << "it had asked for sound too";
  EXPECT_EQ(stream_->counts().voices_failed, 1U);
  text(100);
  EXPECT_TRUE(all_of<SpeechText>(reads->take_all()).empty());
}

TEST_F(TextTest, VoiceThatBecomesReady_GetsWhatIsBeingSaid) {
  const auto viewer = connect({});
  viewer->take_all();
  text();
  frame(0, 5);
  EXPECT_EQ(all_of<Frames>(viewer->take_all()).size(), 1U);
  say(*viewer, {VoiceState::ready, 0, 0, 0});
  EXPECT_EQ(all_of<SpeechText>(viewer->take_all()).size(), 1U);
  frame(40, 6);
  EXPECT_TRUE(viewer->take_all().empty());
}

TEST_F(TextTest, SlowReader_GetsNewestStateAndText) {
  const auto slow = reader();
  slow->socket->stop_reading();
  for (int k = 0; k < 8; ++k) frame(40 * k, static_cast<std::int16_t>(k));
  text();
  slow->socket->read_again(*slow->connection);
  const auto got = slow->take_all();
  ASSERT_FALSE(got.empty());
  EXPECT_EQ(all_of<SpeechText>(got).size(), 1U);
}

TEST_F(TextTest, SlowReader_StillGetsTheEndOfASpeechThatIsStopped) {
  const auto slow = reader();
  text();
  ASSERT_EQ(all_of<SpeechText>(slow->take_all()).size(), 1U);
  slow->socket->stop_reading();
  for (int k = 0; k < 8; ++k) text(100);  // more than wait for it
  stream_->end_playing(ticket_, true);
  slow->socket->read_again(*slow->connection);
  const auto got = slow->take_all();
  const auto texts = all_of<SpeechText>(got);
  ASSERT_FALSE(texts.empty());
  EXPECT_EQ(texts.back().text, "") << "its voice still speaks";
  ASSERT_TRUE(std::holds_alternative<Keyframe>(got.back())) << "and then come frames";
  ASSERT_TRUE(stream_->publish_request({frame_with(7)}));
  EXPECT_TRUE(all_of<SpeechText>(slow->take_all()).empty()) << "once";
}

TEST_F(TextTest, Boundaries_AreCounted_AndCheckedAgainstWhatWasSent) {
  const auto reads = reader();
  text();
  reads->take_all();
  say(*reads, {VoiceState::reached, 1, 5, 200});
  say(*reads, {VoiceState::ended, 1, 8, 500});
  EXPECT_TRUE(reads->take_all().empty()) << "no answer";
  EXPECT_EQ(stream_->counts().words_reached, 1U);
  say(*reads, {VoiceState::reached, 2, 0, 0});
  const auto refused = all_of<StreamError>(reads->take_all());
  ASSERT_EQ(refused.size(), 1U);
  EXPECT_EQ(refused[0].code, StreamErrorCode::out_of_range);
  EXPECT_EQ(refused[0].where, "/speech");
}

TEST_F(TextTest, Boundaries_OfWhoGetsFramesOrPublishes_AreRefused) {
  const auto viewer = connect({});
  viewer->take_all();
  text();
  say(*viewer, {VoiceState::reached, 1, 0, 0});
  EXPECT_EQ(all_of<StreamError>(viewer->take_all()).at(0).code, StreamErrorCode::invalid_argument);
  Hello hello;
  hello.role = StreamRole::publish;
  hello.take_over = true;
  const auto publisher = connect(hello);
  publisher->take_all();
  say(*publisher, {VoiceState::ready, 0, 0, 0});
  EXPECT_EQ(all_of<StreamError>(publisher->take_all()).at(0).code, StreamErrorCode::invalid_argument);
}

TEST_F(TextTest, TextOfAClient_IsRefused) {
  const auto reads = reader();
  reads->connection->receive(encode_json(Message(sentence())), false);
  EXPECT_EQ(all_of<StreamError>(reads->take_all()).at(0).code, StreamErrorCode::invalid_argument);
}

TEST_F(TextTest, ReaderThatLeaves_IsSentNothing) {
  const auto reads = reader();
  reads->leave();
  text();
  EXPECT_EQ(stream_->counts().texts_sent, 0U);
}

TEST_F(TextTest, Player_SendsASentenceASecondBeforeItsTime) {
  const auto reads = reader();
  const auto source = std::make_shared<GrowingSource>(standard_quantizers());
  ASSERT_TRUE(source->add_part({}, 0.0, 4000.0));
  ASSERT_TRUE(source->add_texts({sentence(120), sentence(2000)}));
  source->finish();
  Player player("1", stream_, ticket_, source, {}, began_);
  player.play(began_);
  const auto first = reads->take_all();
  ASSERT_EQ(first.size(), 1U) << "the text, and no frame";
  player.play(began_ + milliseconds(999));
  EXPECT_TRUE(reads->take_all().empty());
  player.play(began_ + milliseconds(1000));
  const auto second = all_of<SpeechText>(reads->take_all());
  ASSERT_EQ(second.size(), 1U);
  EXPECT_EQ(second[0].media_time - std::get<SpeechText>(first[0]).media_time, 1880U);
}

// ---- captions

class CaptionsTest : public TextTest {
 protected:
  static Hello hello() {
    Hello hello;
    hello.captions = true;
    return hello;
  }
  std::shared_ptr<FakeClient> viewer() {
    auto client = connect(hello());
    client->take_all();
    return client;
  }
  static void wish(FakeClient& client, bool on) {
    client.connection->receive(encode_json(Message(CaptionsWish{on})), false);
  }
};

TEST_F(CaptionsTest, Viewer_GetsTextBesideFramesAndSound) {
  auto wishes = hello();
  wishes.sound = true;
  const auto sees = connect(wishes);
  sees->take_all();
  text();
  frame(0, 5);
  stream_->play_sound(ticket_, began_, {0x18, 1});
  const auto got = sees->take_all();
  ASSERT_EQ(got.size(), 3U);
  EXPECT_EQ(std::get<SpeechText>(got[0]).text, "Good day");
  EXPECT_EQ(all_of<Frames>(got).size(), 1U);
  EXPECT_EQ(all_of<SoundPacket>(got).size(), 1U);
}

TEST_F(CaptionsTest, NotAskedFor_ChangeNoByte) {
  const auto plain = connect({});
  plain->socket->take_payloads();
  frame(0, 5);
  text();
  frame(40, 5);
  const auto sees = viewer();
  wish(*sees, false);
  stream_->end_playing(ticket_, false);
  EXPECT_EQ(plain->socket->take_payloads().size(), 2U) << "the frames alone";
}

TEST_F(CaptionsTest, ReaderThatShowsThem_GetsEachTextOnceAndNoFrames) {
  auto wishes = hello();
  wishes.text = true;
  const auto reads = connect(wishes);
  reads->take_all();
  text();
  frame(0, 5);
  const auto got = reads->take_all();
  ASSERT_EQ(got.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<SpeechText>(got[0]));
  wish(*reads, false);
  wish(*reads, true);
  EXPECT_TRUE(reads->take_all().empty()) << "it has it already";
}

TEST_F(CaptionsTest, LateViewer_GetsWhatIsBeingSaid) {
  text();
  text(2000);
  frame(0, 5);
  const auto late = connect(hello());
  const auto texts = all_of<SpeechText>(late->take_all());
  ASSERT_EQ(texts.size(), 2U);
  EXPECT_EQ(texts[0].speech, 1U);
  EXPECT_EQ(texts[1].media_time - texts[0].media_time, 2000U);
}

TEST_F(CaptionsTest, Resume_BringsAllFramesAndTheTextAgain) {
  const auto sees = viewer();
  frame(0, 1);
  text();
  for (int k = 1; k < 5; ++k) frame(40 * k, 5);
  auto wishes = hello();
  wishes.resume = ResumePoint{7, 1};
  const auto back = connect(wishes);
  const auto got = back->take_all();
  EXPECT_TRUE(std::get<Header>(got.at(0)).recovered) << "unlike a reader it misses no frame";
  EXPECT_EQ(all_of<Frames>(got).size(), 4U);
  EXPECT_EQ(all_of<SpeechText>(got).at(0).speech, 1U) << "the number that it knows";
}

TEST_F(CaptionsTest, Wish_ChangesWhileFramesGoOn) {
  const auto sees = connect({});
  sees->take_all();
  text();
  frame(0, 5);
  EXPECT_EQ(sees->take_all().size(), 1U);
  wish(*sees, true);
  EXPECT_EQ(all_of<SpeechText>(sees->take_all()).size(), 1U) << "what is being said";
  text(500);
  EXPECT_EQ(all_of<SpeechText>(sees->take_all()).size(), 1U);
  wish(*sees, false);
  text(1000);
  frame(40, 6);
  const auto got = sees->take_all();
  ASSERT_EQ(got.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<Frames>(got[0]));
}

TEST_F(CaptionsTest, SpeechThatIsStopped_EndsThem_AndOneThatIsOverDoesNot) {
  const auto sees = viewer();
  text();
  frame(0, 5);
  sees->take_all();
  stream_->end_playing(ticket_, false);
  const auto got = sees->take_all();
  ASSERT_EQ(got.size(), 1U) << "no keyframe: it has all frames";
  EXPECT_EQ(std::get<SpeechText>(got[0]).text, "");
  EXPECT_EQ(std::get<SpeechText>(got[0]).speech, 2U);
}

TEST_F(CaptionsTest, SlowViewer_GetsNewestStateAndText) {
  const auto slow = viewer();
  slow->socket->stop_reading();
  for (int k = 0; k < 8; ++k) frame(40 * k, static_cast<std::int16_t>(k));
  text();
  slow->socket->read_again(*slow->connection);
  const auto got = slow->take_all();
  EXPECT_EQ(all_of<Keyframe>(got).size(), 1U);
  EXPECT_EQ(all_of<SpeechText>(got).size(), 1U);
}

TEST_F(CaptionsTest, TextBesideFramesThatAreNotAllSpeech_IsForCaptionsAlone) {
  const auto sees = viewer();
  const auto reads = reader();
  stream_->publish_text(ticket_, began_, sentence(), false);
  frame(0, 5);
  EXPECT_EQ(all_of<SpeechText>(sees->take_all()).size(), 1U);
  const auto got = reads->take_all();
  ASSERT_EQ(got.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<Frames>(got[0]));
  stream_->publish_text(ticket_, began_ + milliseconds(100), {}, false);
  EXPECT_EQ(all_of<SpeechText>(sees->take_all()).at(0).text, "");
  EXPECT_TRUE(reads->take_all().empty());
}

TEST_F(CaptionsTest, WishOfAPublisher_IsRefused) {
  Hello hello;
  hello.role = StreamRole::publish;
  hello.take_over = true;
  const auto publisher = connect(hello);
  publisher->take_all();
  wish(*publisher, true);
  EXPECT_EQ(all_of<StreamError>(publisher->take_all()).at(0).code, StreamErrorCode::invalid_argument);
}

}  // namespace
}  // namespace semblante::streams

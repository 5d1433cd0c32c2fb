// Texts are spoken by a voice that is a program of its own, kept with sound and face, and said by streams.

#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/integration/cli/program.h"
#include "tests/integration/server/model_flow.h"

namespace semblante::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

constexpr const char* beeps = SEMBLANTE_SOURCE_DIR "/server/voice/examples/beeps.py";

void expect_problem(const Reply& reply, int status, const std::string& slug, const std::string& pointer = {}) {
  EXPECT_EQ(reply.status, status) << reply.body;
  const auto problem = json_of(reply);
  EXPECT_EQ(problem.value("type", ""), "/problems/" + slug) << reply.body;
  EXPECT_EQ(problem.value("pointer", ""), pointer) << reply.body;
}

std::size_t blobs_in(const fs::path& data) {
  std::size_t count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(data / "blobs")) {
    const bool unfinished = entry.path().parent_path().filename() == "tmp";
    count += entry.is_regular_file() && !unfinished ? 1 : 0;
  }
  return count;
}

class Speeches : public ::testing::Test {
 protected:
  [[nodiscard]] fs::path data() const { return folder_.path() / "data"; }
  void start(std::vector<std::string> options = {}, const std::string& program = beeps) {
    options.insert(options.end(), {"--voice-program", program, "--recognizer-program", recognizer_});
    server_ = std::make_unique<ServerProcess>(data(), options);
  }
  [[nodiscard]] Reply ask(const std::string& method, const std::string& target, const std::string& body = {},
                          const Fields& fields = {}) const {
    return request(server_->port(), method, target, body, fields);
  }
  [[nodiscard]] Reply say(const json& body, Fields fields = {}) const {
    fields.insert(fields.end(), json_type.begin(), json_type.end());
    return ask("POST", "/v1/speeches", body.dump(), fields);
  }
  [[nodiscard]] std::string path_of(const Reply& reply) const {
    EXPECT_EQ(reply.status, 201) << reply.body;
    return reply.headers.contains("location") ? reply.headers.at("location") : "";
  }

  std::string recognizer_ = "none";
  const json hello_ = {{"text", "Mamma mia! :)"}, {"language", "en"}, {"seed", 7}};
  TemporaryFolder folder_;
  std::unique_ptr<ServerProcess> server_;
};

TEST_F(Speeches, TextBecomesSoundFaceTimelineAndCaptions) {
  start();
  const auto made = say(hello_);
  const auto path = path_of(made);
  const auto speech = json_of(made);
  EXPECT_EQ(speech["request"], hello_);
  EXPECT_EQ(speech["text"], "Mamma mia! ") << "without the smiley";
  EXPECT_EQ(speech["made_by"], "beeps");
  EXPECT_EQ(json_of(ask("GET", path)), speech);
  EXPECT_EQ(json_of(ask("GET", "/v1/speeches"))["speeches"], json::array({speech}));

  const auto audio = ask("GET", path + "/audio");
  EXPECT_EQ(audio.headers.at("content-type"), "audio/wav");
  EXPECT_EQ(audio.body.substr(0, 4), "RIFF");
  EXPECT_NEAR(static_cast<double>(audio.body.size() - 44) / 16.0, speech["duration"].get<double>(), 1.0);
  const auto part = ask("GET", path + "/audio", {}, {{"Range", "bytes=8-11"}});
  EXPECT_EQ(part.status, 206);
  EXPECT_EQ(part.body, "WAVE");
  EXPECT_EQ(ask("GET", path + "/audio", {}, {{"If-None-Match", audio.headers.at("etag")}}).status, 304);

  const auto timeline = json_of(ask("GET", path + "/timeline"));
  ASSERT_EQ(timeline["words"].size(), 2U);
  EXPECT_EQ(timeline["words"][0]["text"], "Mamma");
  EXPECT_EQ(timeline["words"][0]["time"], 120.0);
  EXPECT_LE(timeline["words"][0]["end"], timeline["words"][1]["time"]);
  EXPECT_EQ(timeline["phonemes"][0]["ipa"], "m");
  EXPECT_EQ(timeline["visemes"][1]["viseme"], "p_b_m") << "after the silence";
  const auto face = json_of(ask("GET", path + "/performance"));
  EXPECT_EQ(face["format"], "semblante.performance");
  EXPECT_EQ(face["idle"]["seed"], 7);
  EXPECT_TRUE(std::any_of(face["cues"].begin(), face["cues"].end(),
                          [](const json& cue) { return cue.value("expression", "") == "joy"; }));
  const auto captions = ask("GET", path + "/captions");
  EXPECT_THAT(captions.headers.at("content-type"), HasSubstr("text/vtt"));
  EXPECT_EQ(captions.body.substr(0, 6), "WEBVTT");

  EXPECT_EQ(ask("DELETE", path).status, 204);
  expect_problem(ask("DELETE", path), 404, "not-found");
  expect_problem(ask("GET", path + "/audio"), 404, "not-found");
  EXPECT_EQ(blobs_in(data()), 0U);
}

TEST_F(Speeches, WhatIsWrongIsNamed) {
  start({"--max-speeches", "1"});
  const auto wrong = [&](const char* member, const json& value) {
    auto body = hello_;
    body[member] = value;
    expect_problem(say(body), 422, "invalid-field", std::string("/") + member);
  };
  wrong("text", "");
  wrong("text", 3);
  wrong("text", "a\x02");
  wrong("text", std::string(20'001, 'a'));
  wrong("text", "[joy]a");
  wrong("language", "p t");
  wrong("language", "");
  wrong("voice", "../x");
  wrong("rate", 9);
  wrong("pitch", "high");
  wrong("emotion", "bored");
  wrong("intensity", 1.5);
  wrong("style", "odd");
  wrong("seed", -1);
  wrong("seed", 0.5);
  wrong("ssml", 1);
  wrong("more", 1);
  for (const char* bomb :
       {"<!DOCTYPE a [<!ENTITY b 'cc'>]><speak>&b;</speak>", "<speak><audio src='/etc/passwd'/></speak>", "<speak>",
        "<speak></speak></speak>", "<a", "<speak><emotion name='bored'>a</emotion></speak>",
        "<speak><emotion name='joy'/></speak>"}) {
    auto body = hello_;
    body["ssml"] = true;
    body["text"] = bomb;
    expect_problem(say(body), 422, "invalid-field", "/text");
  }
  // What is not said is the text's fault, not the voice's.
  for (const char* silent : {"  ", "\n\t"}) {
    auto body = hello_;
    body["text"] = silent;
    expect_problem(say(body), 422, "invalid-field", "/text");
  }
  // The voice says what it cannot serve.
  expect_problem(say({{"text", "<speak>a</speak>"}, {"ssml", true}, {"language", "en"}}), 422, "invalid-field",
                 "/text");
  expect_problem(ask("POST", "/v1/speeches", "{\"text\":\"\xff\",\"language\":\"en\"}", json_type), 400,
                 "malformed-request");
  expect_problem(ask("POST", "/v1/speeches", std::string(std::size_t{2} << 20U, ' '), json_type), 413,
                 "content-too-large");
  expect_problem(ask("GET", "/v1/speeches?after=absent"), 400, "invalid-argument", "?after");
  EXPECT_EQ(say(hello_).status, 201);
  expect_problem(say(hello_), 507, "limit-exceeded");
}

TEST_F(Speeches, APartOfALongText_IsItsFirstSentences_WithTheTimesOfTheWhole) {
  start();
  const std::string text = "[joy]A voice that says a long sentence first. Then it goes[/joy] on.";
  const json request = {{"text", text}, {"language", "en"}};
  auto part_request = request;
  part_request["part"] = true;
  const auto path = path_of(say(part_request)), whole_path = path_of(say(request));
  const auto part = json_of(ask("GET", path)), whole = json_of(ask("GET", whole_path));
  EXPECT_EQ(part["text"], "A voice that says a long sentence first. ");
  EXPECT_EQ(part["rest"], "[joy]Then it goes[/joy] on.");
  EXPECT_EQ(whole["rest"], "");
  const auto words = json_of(ask("GET", path + "/timeline"))["words"];
  const auto all = json_of(ask("GET", whole_path + "/timeline"))["words"];
  ASSERT_EQ(words.size(), 8U);
  for (std::size_t i = 0; i < words.size(); ++i) EXPECT_EQ(words[i]["time"], all[i]["time"]) << i;
  EXPECT_LE(part["duration"].get<double>(), all[8]["time"].get<double>()) << "no silence after it";
  auto short_request = hello_;
  short_request["part"] = true;
  EXPECT_EQ(json_of(say(short_request))["rest"], "");
}

TEST_F(Speeches, VoicesAreListed_WithTheQualityOfTheirLanguage) {
  start();
  EXPECT_EQ(json_of(ask("GET", "/v1/voices")),
            json::parse(R"({"voices":[{"voice":"beeps","label":"Tones","language":"en","quality":"measured"}]})"));
  server_.reset();
  start({}, "none");
  EXPECT_EQ(json_of(ask("GET", "/v1/voices")), json::parse(R"({"voices":[]})"));
  server_.reset();
  start({}, "/bin/false");
  expect_problem(ask("GET", "/v1/voices"), 502, "voice-failed");
}

/// A form with the parts, in their order.
std::string form_of(const std::vector<std::pair<std::string, std::string>>& parts) {
  std::string form;
  for (const auto& [name, content] : parts)
    form +=
        "--border\r\nContent-Disposition: form-data; name=\"" + name + "\"; filename=\"a\"\r\n\r\n" + content + "\r\n";
  return form + "--border--\r\n";
}

TEST_F(Speeches, TimelineOfAnotherVoice_BecomesAFaceOnItsSound_WithoutAVoice) {
  start({}, "none");
  const std::string options = R"({"language":"en","text":"[joy]Maps help.[/joy]"})";
  const std::string headtts = R"({"words":["Maps ","help."],"wtimes":[400,760],"wdurations":[300,350],
    "visemes":["PP","aa","PP","SS","E","PP"],"vtimes":[400,470,560,640,800,950],"vdurations":[75,95,80,60,150,90]})";
  const auto le = [](std::uint32_t value, int count) {
    std::string bytes;
    for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFFU);
    return bytes;
  };
  const std::string sound = "RIFF" + le(0, 4) + "WAVEfmt " + le(16, 4) + le(1, 2) + le(1, 2) + le(8000, 4) +
                            le(16000, 4) + le(2, 2) + le(16, 2) + "data" + le(24000, 4) + std::string(24000, '\x11');
  const auto send = [&](const std::vector<std::pair<std::string, std::string>>& parts, Fields fields = {}) {
    fields.insert(fields.end(), form_type.begin(), form_type.end());
    return ask("POST", "/v1/speeches", form_of(parts), fields);
  };
  const auto made = send({{"options", options}, {"timeline", headtts}, {"audio", sound}}, {{"Idempotency-Key", "k"}});
  const auto path = path_of(made);
  const auto speech = json_of(made);
  EXPECT_EQ(speech["request"], json::parse(options));
  EXPECT_EQ(speech["made_by"], "headtts");
  EXPECT_EQ(speech["text"], "Maps help.");
  EXPECT_EQ(speech["duration"], 1500);
  EXPECT_EQ(speech["warnings"], json::array());
  EXPECT_EQ(path_of(send({{"options", options}, {"timeline", headtts}, {"audio", sound}}, {{"Idempotency-Key", "k"}})),
            path);
  EXPECT_TRUE(ask("GET", path + "/audio").body.substr(44) == sound.substr(44)) << "the sound as it was";
  const auto timeline = json_of(ask("GET", path + "/timeline"));
  EXPECT_EQ(timeline["words"][1]["text"], "help.");
  EXPECT_EQ(timeline["words"][1]["time"], 760.0) << "no silence is added";
  EXPECT_EQ(timeline["visemes"][1]["viseme"], "p_b_m");
  const auto face = json_of(ask("GET", path + "/performance"));
  EXPECT_TRUE(std::any_of(face["cues"].begin(), face["cues"].end(),
                          [](const json& cue) { return cue.value("expression", "") == "joy"; }));
  EXPECT_THAT(ask("GET", path + "/captions").body, HasSubstr("Maps <00:00:00.760>help."));

  // The timeline of the server, edited, is one as well; it has no sound.
  const auto again = send({{"options", R"({"language":"en"})"}, {"timeline", timeline.dump()}});
  const auto silent = path_of(again);
  EXPECT_EQ(json_of(again)["links"]["audio"], nullptr);
  EXPECT_EQ(json_of(again)["made_by"], "semblante");
  expect_problem(ask("GET", silent + "/audio"), 404, "not-found");
  EXPECT_EQ(json_of(ask("GET", silent + "/timeline"))["visemes"], timeline["visemes"]);
  ASSERT_EQ(ask("POST", "/v1/streams", R"({"name":"talk"})", json_type).status, 201);
  EXPECT_EQ(ask("POST", "/v1/streams/talk/speech", json{{"speech", json_of(again)["id"]}}.dump(), json_type).status,
            202);

  expect_problem(send({{"options", options}}), 422, "invalid-field", "/timeline");
  expect_problem(send({{"timeline", headtts}}), 422, "invalid-field", "/language");
  expect_problem(send({{"options", options}, {"timeline", "no timeline"}}), 422, "invalid-field", "/timeline");
  expect_problem(send({{"options", options}, {"timeline", R"({"visemes":["Q"],"vtimes":[0],"vdurations":[1]})"}}), 422,
                 "invalid-field", "/timeline/visemes/0");
  expect_problem(send({{"options", options}, {"timeline", headtts}, {"audio", "MP3"}}), 422, "invalid-field", "/audio");
  expect_problem(send({{"options", options}, {"timeline", headtts}, {"audio", ""}}), 422, "invalid-field", "/audio");
  expect_problem(send({{"options", options}, {"timeline", ""}, {"audio", sound}}), 422, "invalid-field", "/timeline");
  const std::string none_chosen =
      "--border\r\nContent-Disposition: form-data; name=\"audio\"; filename=\"\"\r\n\r\n\r\n";
  const auto of_a_page =
      ask("POST", "/v1/speeches", none_chosen + form_of({{"options", options}, {"timeline", headtts}}), form_type);
  EXPECT_EQ(json_of(of_a_page)["links"]["audio"], nullptr) << of_a_page.body;
  expect_problem(send({{"options", R"({"language":"en","format":"smoke"})"}, {"timeline", headtts}}), 422,
                 "invalid-field", "/format");
  expect_problem(send({{"options", R"({"language":"en","text":"[joy]"})"}, {"timeline", headtts}}), 422,
                 "invalid-field", "/text");
  expect_problem(send({{"options", R"({"language":"en","rate":1})"}, {"timeline", headtts}}), 422, "invalid-field",
                 "/rate");
  expect_problem(ask("POST", "/v1/speeches", "x", form_type), 400, "malformed-request");
}

TEST_F(Speeches, ARecordingWithItsText_BecomesAFaceOnItsClock) {
  start();
  const auto send = [&](const json& options, const std::string& sound) {
    return ask("POST", "/v1/speeches", form_of({{"options", options.dump()}, {"audio", sound}}), form_type);
  };
  json slower = hello_;
  slower["rate"] = 0.8;
  const auto first = path_of(say(slower));
  const std::string sound = ask("GET", first + "/audio").body;
  const json options = {{"language", "en"}, {"text", "[joy]Mamma mia![/joy]"}};
  const auto made = send(options, sound);
  const auto path = path_of(made);
  EXPECT_EQ(json_of(made)["made_by"], "recording");
  EXPECT_EQ(json_of(made)["text"], "Mamma mia!");
  EXPECT_TRUE(ask("GET", path + "/audio").body == sound);
  const auto words = json_of(ask("GET", first + "/timeline"))["words"],
             found = json_of(ask("GET", path + "/timeline"))["words"];
  ASSERT_EQ(found.size(), words.size());
  for (std::size_t i = 0; i < words.size(); ++i)
    EXPECT_NEAR(found[i]["time"].get<double>(), words[i]["time"].get<double>(), 40.0) << i;

  const auto heard = send({{"language", "en"}}, sound);
  const auto heard_path = path_of(heard);
  EXPECT_EQ(json_of(heard)["text"], "");
  const auto heard_visemes = json_of(ask("GET", heard_path + "/timeline"))["visemes"];
  EXPECT_GT(heard_visemes.size(), 2U) << "without a text the mouth is heard";
  expect_problem(send({{"language", "en"}, {"text", "a"}, {"format", "polly"}}, sound), 422, "invalid-field",
                 "/format");
  expect_problem(send(options, "no sound"), 422, "invalid-field", "/audio");
  expect_problem(send({{"language", "e n"}, {"text", "a"}}, sound), 422, "invalid-field", "/language");
  server_.reset();
  start({}, "none");
  expect_problem(send(options, sound), 501, "no-voice");
  server_.reset();
  start({}, "/bin/false");
  expect_problem(send(options, sound), 502, "voice-failed");
}

TEST_F(Speeches, ARecordingWithoutItsText_HasTheWordsOfTheRecognizer_WhichNeedsNoVoice) {
  start();
  const std::string sound = ask("GET", path_of(say(hello_)) + "/audio").body;
  server_.reset();
  recognizer_ = (folder_.path() / "recognizer").string();
  std::ofstream(recognizer_) << R"sh(#!/bin/sh
if head -n 1 | grep -q '"language":"en"'; then
  echo '{"protocol":1,"name":"fake","sample_rate":16000}'
  echo '{"heard":"mamma mia","confidence":0.75}'
  echo '{"word":[0,5],"time":120}'; echo '{"word":[6,3],"time":600}'
  echo '{"phoneme":"m","time":120}'; echo '{"phoneme":"a","time":300}'; echo '{"phoneme":"i","time":700}'
  echo '{"end":true}'
else
  echo '{"error":"English alone","of":"language"}'
fi
cat > /dev/null
)sh";
  fs::permissions(recognizer_, fs::perms::owner_all);
  start({}, "none");
  const auto send = [&](const json& options) {
    return ask("POST", "/v1/speeches", form_of({{"options", options.dump()}, {"audio", sound}}), form_type);
  };
  const auto made = send({{"language", "en"}});
  const auto path = path_of(made);
  EXPECT_EQ(json_of(made)["made_by"], "recording, heard by fake");
  EXPECT_EQ(json_of(made)["text"], "mamma mia");
  EXPECT_NE(json_of(made)["warnings"][0].get<std::string>().find("75 %"), std::string::npos);
  EXPECT_NE(ask("GET", path + "/captions").body.find("mamma <00:00:00.600>mia"), std::string::npos);
  EXPECT_TRUE(ask("GET", path + "/audio").body == sound);
  const auto other = send({{"language", "pt-BR"}});
  EXPECT_EQ(json_of(other)["made_by"], "recording, heard by its sound");
  EXPECT_EQ(json_of(other)["text"], "");
}

TEST_F(Speeches, WithoutAVoice_OrWithOneThatFails_TheRestWorks) {
  start({}, "none");
  expect_problem(say(hello_), 501, "no-voice");
  EXPECT_EQ(ask("POST", "/v1/streams", R"({"name":"talk"})", json_type).status, 201);
  expect_problem(ask("POST", "/v1/streams/talk/speech", hello_.dump(), json_type), 501, "no-voice");
  EXPECT_EQ(json_of(ask("GET", "/v1/speeches"))["speeches"].size(), 0U);
  server_.reset();
  for (const char* program : {"/bin/false", "/bin/cat", "/nonexistent/voice"}) {
    start({}, program);
    expect_problem(say(hello_), 502, "voice-failed");
    EXPECT_EQ(ask("GET", "/healthz").status, 200);
    server_.reset();
  }
  EXPECT_EQ(blobs_in(data()), 0U);
}

TEST_F(Speeches, SurviveAKill_AndCheckBackupAndRestoreKnowThem) {
  start();
  const auto path = path_of(say(hello_, {{"Idempotency-Key", "once"}}));
  const auto audio = ask("GET", path + "/audio").body;
  server_->end(SIGKILL);
  start();
  EXPECT_TRUE(ask("GET", path + "/audio").body == audio);
  EXPECT_EQ(path_of(say(hello_, {{"Idempotency-Key", "once"}})), path) << "created once";
  EXPECT_EQ(blobs_in(data()), 4U) << "no start takes a file for unknown";
  const auto etag = ask("GET", path + "/audio").headers.at("etag");
  EXPECT_EQ(server_->end(SIGTERM), 0);

  const auto backup = folder_.path() / "backup", restored = folder_.path() / "restored";
  EXPECT_EQ(run_semblante({"check", "--data", data().string()}).exit_code, 0);
  EXPECT_EQ(run_semblante({"backup", "--data", data().string(), "--to", backup.string()}).exit_code, 0);
  EXPECT_EQ(run_semblante({"restore", "--from", backup.string(), "--data", restored.string()}).exit_code, 0);
  {
    const ServerProcess again(restored, {"--voice-program", "none"});
    EXPECT_TRUE(request(again.port(), "GET", path + "/audio").body == audio) << "no voice is needed";
  }
  const auto hash = etag.substr(std::string("\"sha256-").size(), 64);
  fs::remove(data() / "blobs" / hash.substr(0, 2) / hash);
  const auto found = run_semblante({"check", "--data", data().string()});
  EXPECT_EQ(found.exit_code, 1);
  EXPECT_THAT(found.out + found.err, HasSubstr("speech " + path.substr(path.rfind('/') + 1)));
}

TEST_F(Speeches, TwoThatShareAFile_KeepItUntilTheLastIsRemoved) {
  start();
  const auto first = path_of(say(hello_)), second = path_of(say(hello_));
  EXPECT_EQ(blobs_in(data()), 4U);
  EXPECT_EQ(ask("DELETE", first).status, 204);
  EXPECT_EQ(ask("GET", second + "/audio").status, 200);
  EXPECT_EQ(ask("DELETE", second).status, 204);
  EXPECT_EQ(blobs_in(data()), 0U);
}

TEST_F(Speeches, StreamSaysATextOrAStoredSpeech) {
  start();
  ASSERT_EQ(ask("POST", "/v1/streams", R"({"name":"talk"})", json_type).status, 201);
  const auto speak = [&](const json& body) { return ask("POST", "/v1/streams/talk/speech", body.dump(), json_type); };
  // It still plays when a slow machine asks next.
  std::string text;
  for (int i = 0; i < 40; ++i) text += "Mamma mia! ";
  const auto playing = speak({{"text", text}, {"language", "en"}});
  ASSERT_EQ(playing.status, 202) << playing.body;
  EXPECT_EQ(json_of(ask("GET", "/v1/streams/talk"))["active_source"], "performance");
  EXPECT_EQ(json_of(ask("GET", playing.headers.at("location")))["id"], json_of(playing)["id"]);
  const auto stored = json_of(say(hello_))["id"];
  expect_problem(speak({{"speech", stored}}), 409, "conflict");
  EXPECT_EQ(speak({{"speech", stored}, {"take_over", true}}).status, 202);
  expect_problem(speak({{"speech", "absent"}}), 422, "invalid-field", "/speech");
  expect_problem(speak({{"speech", stored}, {"text", "a"}}), 422, "invalid-field", "/text");
  expect_problem(speak({{"text", "a"}}), 422, "invalid-field", "/language");
  expect_problem(ask("POST", "/v1/streams/absent/speech", hello_.dump(), json_type), 404, "not-found");
}

/// What a subscriber of the stream gets until it has ended, from its header on.
std::vector<json> all_messages(WebSocket& subscriber) {
  std::vector<json> messages;
  while (const auto text = subscriber.receive()) {
    messages.push_back(json::parse(*text));
    if (messages.back()["type"] == "end") break;
  }
  return messages;
}

TEST_F(Speeches, WhoAsksForSound_HearsWhatTheStreamSays) {
  start();
  const auto kept = json_of(say(hello_));
  for (const auto& wish : {hello_, json{{"speech", kept["id"]}}}) {
    ASSERT_EQ(ask("POST", "/v1/streams", R"({"name":"talk"})", json_type).status, 201);
    WebSocket listener(server_->port(), "/v1/streams/talk", "semblante.v1.json");
    WebSocket viewer(server_->port(), "/v1/streams/talk", "semblante.v1.json");
    listener.send_text(R"({"type":"hello","version":1,"sound":true})");
    viewer.send_text(R"({"type":"hello","version":1})");
    const auto header = json::parse(listener.receive().value_or("{}"));
    EXPECT_EQ(header["sound"], (json{{"codec", "opus"}, {"rate", 48000}, {"channels", 1}, {"bitrate", 20000}}));
    EXPECT_FALSE(json::parse(viewer.receive().value_or("{}")).contains("sound"));

    ASSERT_EQ(ask("POST", "/v1/streams/talk/speech", wish.dump(), json_type).status, 202);
    for (int i = 0; i < 600 && !json_of(ask("GET", "/v1/streams/talk"))["playing"].is_null(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    ASSERT_EQ(ask("DELETE", "/v1/streams/talk").status, 204);

    std::vector<std::uint64_t> heard;
    std::uint64_t first_frame = 0, last_frame = 0;
    for (const auto& message : all_messages(listener)) {
      const std::string type = message["type"];
      if (type == "sound") heard.push_back(message["media_time"].get<std::uint64_t>());
      if (type != "frames") continue;
      if (first_frame == 0) first_frame = message["media_time"].get<std::uint64_t>();
      last_frame = message["media_time"].get<std::uint64_t>();
    }
    ASSERT_GE(heard.size(), 5U);
    for (const auto time : heard) EXPECT_EQ((time - heard.front()) % 60, 0U) << "on one clock, packet by packet";
    EXPECT_GE(heard.front() + 1, first_frame);
    EXPECT_LE(heard.back(), last_frame);
    for (const auto& message : all_messages(viewer)) EXPECT_NE(message["type"], "sound");
  }
}

TEST_F(Speeches, WhoHasAVoice_GetsTheTextOfWhatTheStreamSays_AndFramesWhenItFails) {
  start();
  const json talk = {{"text", "Bom dia a todos. :) Tudo bem?"}, {"language", "pt-BR"}, {"seed", 7}};
  const auto kept = json_of(say(talk));
  for (const auto& wish : {talk, json{{"speech", kept["id"]}}}) {
    ASSERT_EQ(ask("POST", "/v1/streams", R"({"name":"talk"})", json_type).status, 201);
    WebSocket reader(server_->port(), "/v1/streams/talk", "semblante.v1.json");
    WebSocket mute(server_->port(), "/v1/streams/talk", "semblante.v1.json");
    for (auto* one : {&reader, &mute}) {
      one->send_text(R"({"type":"hello","version":1,"text":true})");
      EXPECT_EQ(json::parse(one->receive().value_or("{}"))["type"], "header");
    }
    mute.send_text(R"({"type":"spoken","state":"failed"})");
    ASSERT_EQ(ask("POST", "/v1/streams/talk/speech", wish.dump(), json_type).status, 202);
    for (int i = 0; i < 600 && !json_of(ask("GET", "/v1/streams/talk"))["playing"].is_null(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    ASSERT_EQ(ask("DELETE", "/v1/streams/talk").status, 204);

    std::string said;
    std::size_t frames = 0;
    for (const auto& message : all_messages(reader)) {
      if (message["type"] == "frames") ++frames;
      if (message["type"] != "text") continue;
      EXPECT_EQ(message["language"], "pt-BR");
      EXPECT_FALSE(message["score"].get<std::string>().empty());
      said += message["text"].get<std::string>() + "|";
    }
    EXPECT_EQ(said, "Bom dia a todos.|Tudo bem?|");
    EXPECT_LE(frames, 1U) << "what is left of the last batch";
    std::size_t of_mute = 0;
    for (const auto& message : all_messages(mute)) {
      EXPECT_NE(message["type"], "text");
      if (message["type"] == "frames") ++of_mute;
    }
    EXPECT_GT(of_mute, 10U);
  }
}

TEST_F(Speeches, MouthOfTheStreamMoves) {
  start();
  ASSERT_EQ(ask("POST", "/v1/streams", R"({"name":"talk"})", json_type).status, 201);
  const auto recording = json_of(ask("POST", "/v1/streams/talk/recordings"))["id"].get<std::string>();
  ASSERT_EQ(ask("POST", "/v1/streams/talk/speech", hello_.dump(), json_type).status, 202);
  // It has ended when nothing plays any more.
  for (int i = 0; i < 600; ++i) {
    if (json_of(ask("GET", "/v1/streams/talk"))["playing"].is_null()) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  ASSERT_EQ(ask("POST", "/v1/recordings/" + recording + "/stop").status, 200);
  const auto frames = json_of(ask("GET", "/v1/recordings/" + recording + "/frames?limit=1000"))["frames"];
  int closed = 0, open = 0, smiles = 0;
  for (const auto& frame : frames) {
    const auto viseme = frame.value("viseme", json::object());
    const int select = viseme.value("select1", 0), blend = viseme.value("blend", 0);
    const int other = viseme.value("select2", 0);
    closed += (select == 1 && blend == 63) || (other == 1 && blend == 0 && !viseme.empty()) ? 1 : 0;
    open += select == 10 && blend > 20 ? 1 : 0;
    smiles += frame.value("expression", json::object()).value("select1", 0) == 1 ? 1 : 0;
  }
  EXPECT_GE(closed, 3) << frames.size();
  EXPECT_GE(open, 2);
  EXPECT_GE(smiles, 5);
}

}  // namespace
}  // namespace semblante::test

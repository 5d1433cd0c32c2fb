#include "protocol/cpp/packed_text.h"

#include <fstream>
#include <random>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/json_codec.h"
#include "protocol/cpp/speech_score.h"

/// Texts in their packed form: SPEC.md, "Packed text".
namespace semblante {
namespace {

using Bytes = std::vector<std::uint8_t>;
using nlohmann::json;

Bytes packed(const SpeechText& text) {
  Bytes bytes;
  write_packed_text(text, bytes);
  return bytes;
}

SpeechText hello() { return {3, 5500, "en", "Am pe", {0xab, 0x11, 0x19, 0xb3}}; }

SpeechText random_text(std::mt19937& random) {
  static const std::vector<std::string> pieces = {
      "a", "Be", "\u00e7\u00e3o", " ", "\t", "\n", "\U0001F600", "the ", "q", ".", "\xd0\x96", std::string(1, '\0')};
  SpeechText text{random(), random(), random() % 2 == 0 ? "pt-BR" : "x-\u00e9", "", {}};
  for (auto count = random() % 30; count > 0; --count) text.text += pieces[random() % pieces.size()];
  for (auto words = word_begins(text.text).size(); words > 0; --words) {
    text.score.push_back(static_cast<std::uint8_t>(random() % 15 << 4U | 8U | random() % 8));
    for (auto steps = random() % 6; steps > 0; --steps)
      text.score.push_back(static_cast<std::uint8_t>(random() % 15 << 4U | random() % 8));
    if (random() % 3 == 0)
      text.score.insert(text.score.end(),
                        {static_cast<std::uint8_t>(0xf1 + random() % 6), static_cast<std::uint8_t>(random() % 64)});
    if (random() % 3 == 0) text.score.push_back(0xf0);
  }
  return text;
}

TEST(PackedText, AnyText_IsReadAsItWasWritten) {
  std::mt19937 random(5);
  for (int round = 0; round < 300; ++round) {
    const auto text = random_text(random);
    ASSERT_TRUE(check_text(text));
    const auto read = read_packed_text(packed(text));
    ASSERT_TRUE(read) << read.error().where << " " << read.error().message;
    EXPECT_EQ(*read, text);
  }
}

TEST(PackedText, LargestText_IsReadAsItWasWritten) {
  SpeechText text{9007199254740991, 9007199254740991, std::string(64, 'x'), std::string(max_speech_text_bytes, 'z'),
                  Bytes(max_score_bytes, 0x77)};
  text.score[0] = 0x7f;
  const auto read = read_packed_text(packed(text));
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, text);
}

TEST(PackedText, Order_DoesNotMatter) {
  const auto first = packed(hello());
  packed({1, 2, "pt-BR", "Outra", {0xab}});
  EXPECT_EQ(packed(hello()), first) << "no text depends on those before it";
}

TEST(PackedText, ClientsReadIt_AndServersDoNot) {
  const auto bytes = packed(hello());
  const auto seen = FrameDecoder().decode_from_server(bytes);
  ASSERT_TRUE(seen);
  EXPECT_EQ(std::get<SpeechText>(*seen), hello());
  const auto refused = FrameDecoder().decode(bytes);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
}

json text_vectors() { return json::parse(std::ifstream(SEMBLANTE_SOURCE_DIR "/protocol/vectors/v1/packed_text.json")); }

Bytes bytes_of(const json& vector) {
  const auto hex = vector.at("binary").get<std::string>();
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes.push_back(static_cast<std::uint8_t>(std::stoul(hex.substr(i, 2), nullptr, 16)));
  return bytes;
}

TEST(PackedText, Vectors_MeanTheirJson_AndAreWrittenSo) {
  std::size_t packed_bytes = 0, plain_bytes = 0;
  const json all = text_vectors();
  ASSERT_FALSE(all.at("messages").empty());
  for (const json& vector : all.at("messages")) {
    const auto name = vector.at("name").get<std::string>();
    const auto meaning = decode_json(vector.at("json").dump());
    ASSERT_TRUE(meaning) << name;
    const auto& text = std::get<SpeechText>(*meaning);
    const auto read = read_packed_text(bytes_of(vector));
    ASSERT_TRUE(read) << name << ": " << read.error().message;
    EXPECT_EQ(*read, text) << name;
    EXPECT_EQ(packed(text), bytes_of(vector)) << name;
    if (!name.starts_with("talk")) continue;
    Bytes plain;
    encode_message(text, plain);
    plain_bytes += plain.size();
    packed_bytes += bytes_of(vector).size();
  }
  EXPECT_LT(packed_bytes * 2, plain_bytes) << "of sentences that the model does not know";
}

TEST(PackedText, Vectors_Refused_AreNamedByCodeAndPointer) {
  const json all = text_vectors();
  ASSERT_FALSE(all.at("refused").empty());
  for (const json& vector : all.at("refused")) {
    const auto name = vector.at("name").get<std::string>();
    const auto read = read_packed_text(bytes_of(vector));
    ASSERT_FALSE(read) << name;
    const auto error = to_stream_error(read.error());
    EXPECT_EQ(stream_error_code_names.names[static_cast<std::size_t>(error.code)], vector.at("code").get<std::string>())
        << name;
    EXPECT_EQ(error.where, vector.at("where").get<std::string>()) << name;
  }
}

TEST(PackedText, EveryPrefix_IsRefused) {
  const auto bytes = packed(hello());
  for (std::size_t size = 0; size + 1 < bytes.size(); ++size) {
    const auto read = read_packed_text({bytes.data(), size});
    EXPECT_TRUE(!read || *read != hello()) << size;
  }
}

TEST(PackedText, RandomBytes_AreRefusedOrAText) {
  std::mt19937 random(6);
  for (int round = 0; round < 2000; ++round) {
    Bytes bytes = {packed_text_type, 1, 1};
    for (auto count = random() % 60; count > 0; --count)
      bytes.push_back(static_cast<std::uint8_t>(random() % 3 == 0 ? random() : 0));
    const auto read = read_packed_text(bytes);
    EXPECT_TRUE(!read || check_text(*read));
  }
}

}  // namespace
}  // namespace semblante

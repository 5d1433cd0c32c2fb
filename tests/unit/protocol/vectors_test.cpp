#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/json_codec.h"
#include "protocol/cpp/opus_packet.h"
#include "protocol/cpp/packed_codec.h"
#include "protocol/cpp/quantizers.h"
#include "protocol/cpp/rig_document.h"
#include "protocol/cpp/speech_score.h"
#include "protocol/cpp/weights_format.h"
#include "tests/support/frame_encoder.h"

/// The golden files of protocol/vectors, which the TypeScript tests read too.
namespace semblante {
namespace {

using nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

std::string vector_file(const std::string& name) {
  std::ifstream file(std::string(SEMBLANTE_SOURCE_DIR) + "/protocol/vectors/v1/" + name, std::ios::binary);
  EXPECT_TRUE(file) << name;
  return {std::istreambuf_iterator<char>(file), {}};
}

Bytes from_hex(const std::string& hex) {
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes.push_back(static_cast<std::uint8_t>(std::stoul(hex.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

TEST(Vectors, Messages_BinaryAndJson_MeanTheSame) {
  const json vectors = json::parse(vector_file("messages.json"));
  FrameEncoder encoder;
  FrameDecoder decoder;
  ASSERT_FALSE(vectors.at("messages").empty());
  for (const json& vector : vectors.at("messages")) {
    const std::string name = vector.at("name");
    const Bytes bytes = from_hex(vector.at("binary"));
    const auto from_text = decode_json(vector.at("json").dump());
    ASSERT_TRUE(from_text.ok()) << name << ": " << from_text.error().message;
    const auto from_bytes = decoder.decode(bytes);
    ASSERT_TRUE(from_bytes.ok()) << name << ": " << from_bytes.error().message;
    EXPECT_EQ(*from_bytes, *from_text) << name;
    EXPECT_EQ(encoder.encode(*from_text), bytes) << name;
    EXPECT_EQ(json::parse(encode_json(*from_text)), vector.at("json")) << name;
  }
}

TEST(Vectors, StandardSteps_LeftOutOrWrittenOut_AreTheSame) {
  const json vectors = json::parse(vector_file("messages.json"));
  std::size_t headers = 0;
  for (const json& vector : vectors.at("messages")) {
    const std::string name = vector.at("name");
    if (name.find("header with the standard steps") != 0) continue;
    const auto message = FrameDecoder().decode(from_hex(vector.at("binary")));
    ASSERT_TRUE(message.ok()) << name;
    EXPECT_EQ(std::get<Header>(*message).quantizers.empty(), headers == 0) << name;
    EXPECT_EQ(quantizers_of(std::get<Header>(*message)), standard_quantizers()) << name;
    ++headers;
  }
  EXPECT_EQ(headers, 2U);
}

/// The message of a vector, which both forms give and which is written as both.
void read_both_forms(const json& vector, Message& message) {
  const std::string name = vector.at("name");
  const Bytes bytes = from_hex(vector.at("binary"));
  const auto from_text = decode_json(vector.at("json").dump());
  ASSERT_TRUE(from_text.ok()) << name << ": " << from_text.error().message;
  const auto from_bytes = FrameDecoder().decode(bytes);
  ASSERT_TRUE(from_bytes.ok()) << name << ": " << from_bytes.error().message;
  EXPECT_EQ(*from_bytes, *from_text) << name;
  EXPECT_EQ(FrameEncoder().encode(*from_text), bytes) << name;
  EXPECT_EQ(json::parse(encode_json(*from_text)), vector.at("json")) << name;
  message = *from_text;
}

TEST(Vectors, AppendedFields_BinaryAndJson_MeanTheSame) {
  const json vectors = json::parse(vector_file("appended_fields.json"));
  ASSERT_EQ(vectors.at("messages").size(), 6U);
  std::map<std::string, Message> by_name;
  for (const json& vector : vectors.at("messages")) {
    const std::string name = vector.at("name");
    Message message;
    ASSERT_NO_FATAL_FAILURE(read_both_forms(vector, message));
    by_name.emplace(name, message);
  }
  for (const json& vector : vectors.at("reads_as_default")) {
    const auto other_form = FrameDecoder().decode(from_hex(vector.at("binary")));
    ASSERT_TRUE(other_form.ok()) << vector;
    EXPECT_EQ(*other_form, by_name.at(vector.at("as"))) << vector;
  }
  const auto absent = FrameDecoder().decode(from_hex(vectors.at("reads_as_absent")));
  ASSERT_TRUE(absent.ok());
  EXPECT_EQ(std::get<Header>(*absent).viseme_share, std::nullopt);
}

TEST(Vectors, PackedStreams_BinaryAndJson_MeanTheSame) {
  const json vectors = json::parse(vector_file("packed.json"));
  ASSERT_EQ(vectors.at("streams").size(), 6U);
  for (const json& stream : vectors.at("streams")) {
    const std::string name = stream.at("name");
    std::optional<PackedEncoder> encoder;
    std::vector<FrameDecoder> readers;  // one more at each keyframe, which it begins with
    for (const json& vector : stream.at("messages")) {
      const Bytes bytes = from_hex(vector.at("binary"));
      const auto meant = decode_json(vector.at("json").dump());
      ASSERT_TRUE(meant.ok()) << name << ": " << meant.error().message;
      const auto* keyframe = std::get_if<Keyframe>(&*meant);
      if (keyframe != nullptr) {
        if (!encoder) encoder.emplace(*keyframe);
        EXPECT_EQ(encoder->keyframe(), bytes) << name;
        readers.emplace_back();
      } else {
        EXPECT_EQ(encoder->encode(std::get<Frames>(*meant)), bytes) << name;
      }
      for (FrameDecoder& reader : readers) {
        if (keyframe != nullptr && &reader != &readers.back()) continue;
        const auto from_bytes = reader.decode(bytes);
        ASSERT_TRUE(from_bytes.ok()) << name << ": " << from_bytes.error().message;
        EXPECT_EQ(*from_bytes, *meant) << name;
      }
    }
  }
}

TEST(Vectors, PackedRefused_AreNamedByCodeAndPointer) {
  const json vectors = json::parse(vector_file("packed_refused.json"));
  ASSERT_FALSE(vectors.at("refused").empty());
  for (const json& vector : vectors.at("refused")) {
    const std::string name = vector.at("name");
    FrameDecoder decoder;
    for (const json& before : vector.at("before")) ASSERT_TRUE(decoder.decode(from_hex(before)).ok()) << name;
    const auto result = decoder.decode(from_hex(vector.at("binary")));
    ASSERT_FALSE(result.ok()) << name;
    const StreamError error = to_stream_error(result.error());
    EXPECT_EQ(stream_error_code_names.names[static_cast<std::size_t>(error.code)], vector.at("code").get<std::string>())
        << name;
    EXPECT_EQ(error.where, vector.at("where").get<std::string>()) << name;
  }
}

TEST(Vectors, Sound_BinaryAndJson_MeanTheSame) {
  const json vectors = json::parse(vector_file("sound.json"));
  std::size_t packets = 0;
  for (const json& vector : vectors.at("messages")) {
    const std::string name = vector.at("name");
    Message message;
    ASSERT_NO_FATAL_FAILURE(read_both_forms(vector, message));
    const auto* sound = std::get_if<SoundPacket>(&message);
    if (sound == nullptr) continue;
    ++packets;
    EXPECT_EQ(opus_packet_ms(sound->packet), vector.at("lasts").get<double>()) << name;
  }
  EXPECT_EQ(packets, 4U);
}

TEST(Vectors, Text_BinaryAndJson_MeanTheSame) {
  const json vectors = json::parse(vector_file("text.json"));
  std::size_t texts = 0;
  for (const json& vector : vectors.at("messages")) {
    const std::string name = vector.at("name");
    Message message;
    ASSERT_NO_FATAL_FAILURE(read_both_forms(vector, message));
    const auto* text = std::get_if<SpeechText>(&message);
    if (text == nullptr) continue;
    ++texts;
    const auto score = read_score(text->score);
    ASSERT_TRUE(score) << name;
    json steps = json::array(), expressions = json::array();
    for (const auto& step : score->steps)
      steps.push_back({step.viseme, step.begins_word ? 1 : 0, step.end - step.begin});
    for (const auto& one : score->expressions) expressions.push_back({one.begin, one.expression, one.intensity});
    EXPECT_EQ(steps, vector.at("steps")) << name;
    EXPECT_EQ(expressions, vector.at("expressions")) << name;
    EXPECT_EQ(write_score(*score), text->score) << name;
  }
  EXPECT_EQ(texts, 4U);
}

TEST(Vectors, Refused_BinaryAndJson_AreNamedByCodeAndPointer) {
  json all = json::parse(vector_file("refused.json")).at("refused");
  const json of_sound = json::parse(vector_file("sound.json"));
  for (const json& vector : of_sound.at("refused")) all.push_back(vector);
  const json of_text = json::parse(vector_file("text.json"));
  for (const json& vector : of_text.at("refused")) all.push_back(vector);
  ASSERT_GT(all.size(), 20U);
  for (const json& vector : all) {
    const std::string name = vector.at("name");
    FrameDecoder decoder;
    ASSERT_TRUE(decoder.decode(FrameEncoder().encode(Keyframe{})).ok());
    const auto result = vector.contains("binary") ? decoder.decode(from_hex(vector.at("binary")))
                                                  : decode_json(vector.at("json").get<std::string>());
    ASSERT_FALSE(result.ok()) << name;
    const StreamError error = to_stream_error(result.error());
    EXPECT_EQ(stream_error_code_names.names[static_cast<std::size_t>(error.code)], vector.at("code").get<std::string>())
        << name;
    EXPECT_EQ(error.where, vector.at("where").get<std::string>()) << name;
  }
}

TEST(Vectors, Weights_AllWidths_GiveTheirMeaning) {
  for (const char* name : {"weights-8", "weights-12", "weights-16", "../v2/weights-12", "../v3/weights-12"}) {
    const std::string file = vector_file(std::string(name) + ".bin");
    const json meaning = json::parse(vector_file(std::string(name) + ".json"));
    const auto table = decode_weights(Bytes(file.begin(), file.end()));
    ASSERT_TRUE(table.ok()) << name << ": " << table.error().message;
    EXPECT_EQ(to_hex(table->mesh_sha256), meaning.at("mesh_sha256").get<std::string>());
    EXPECT_EQ(json(table->rigid), meaning.at("rigid"));
    EXPECT_EQ(json(table->turn), meaning.value("turn", json::array()));
    const double total = std::pow(2.0, meaning.at("bits").get<int>()) - 1;
    json rows = json::array();
    for (std::size_t v = 0; v < table->vertex_count; ++v) {
      json row = json::array();
      for (std::size_t i = 0; i < table->rows.points_of(v).size(); ++i) {
        row.push_back({table->rows.points_of(v)[i].value(), std::lround(table->rows.weights_of(v)[i] * total)});
      }
      rows.push_back(row);
    }
    EXPECT_EQ(rows, meaning.at("rows")) << name;
  }
}

TEST(Vectors, Rig_ReadAndWritten_IsTheSame) {
  for (const char* name : {"rig.json", "../v2/rig.json", "../v3/rig.json"}) {
    const std::string text = vector_file(name);
    const auto rig = read_rig(text);
    ASSERT_TRUE(rig.ok()) << rig.error().where << ": " << rig.error().message;
    EXPECT_EQ(write_rig(*rig) + "\n", text);
  }
}

}  // namespace
}  // namespace semblante

#include "protocol/cpp/weights_format.h"

#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <zlib.h>

#include <gtest/gtest.h>

#include "protocol/cpp/byte_io.h"
#include "protocol/cpp/weights_layout.h"

namespace semblante {
namespace {

using namespace weights_layout;
using Bytes = std::vector<std::uint8_t>;

void add_row(InfluenceTable& table, std::vector<std::pair<int, float>> row, std::uint8_t rigid = 0) {
  for (const auto& [point, weight] : row) table.rows.push(FeaturePointId(static_cast<std::uint8_t>(point)), weight);
  table.rows.end_row();
  table.rigid.push_back(rigid);
  ++table.vertex_count;
}

/// Every kind of row: none, one point, sums to one, sums to more (a tongue: its own point and the jaw), an eye.
InfluenceTable small_table() {
  InfluenceTable table;
  for (std::size_t i = 0; i < table.mesh_sha256.size(); ++i) table.mesh_sha256[i] = static_cast<std::uint8_t>(i * 7);
  add_row(table, {});
  add_row(table, {{1, 1.0F}});
  add_row(table, {{1, 0.5F}, {7, 0.25F}, {30, 0.25F}});
  add_row(table, {{1, 0.4F}, {7, 0.35F}, {30, 0.25F}});
  add_row(table, {{1, 1.0F}, {50, 1.0F}});
  add_row(table, {{1, 0.3F}});
  add_row(table, {}, 1);
  add_row(table, {}, 1);
  add_row(table, {}, 2);
  return table;
}

/// A smooth field over a strip, as weights over a skin are: sets of neighbours are alike, weights change little.
InfluenceTable smooth_table(std::uint32_t vertices) {
  InfluenceTable table;
  std::mt19937 random(7);
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const int centre = static_cast<int>(v * 70 / vertices);
    std::vector<std::pair<int, float>> row;
    float sum = 0;
    for (int i = 0; i < 1 + static_cast<int>(v / 100 % 8); ++i) {
      row.emplace_back(centre + i, 0.1F + static_cast<float>(random() % 1000) / 10000.0F);
      sum += row.back().second;
    }
    for (auto& [point, weight] : row) weight /= sum;
    add_row(table, row, static_cast<std::uint8_t>(v * 3 / vertices));
  }
  return table;
}

void fix_checksum(Bytes& bytes) {
  byte_io::put_u32(&bytes[at_crc], 0);
  byte_io::put_u32(&bytes[at_crc], static_cast<std::uint32_t>(crc32_z(0, bytes.data(), bytes.size())));
}

/// The bytes of `small_table` with its payload changed by hand and everything around it right again.
template <class Change>
Bytes with_payload(const InfluenceTable& table, Change change) {
  Bytes bytes = encode_weights(table);
  Bytes raw(byte_io::get_u32(&bytes[at_raw_bytes]));
  uLongf raw_size = raw.size();
  EXPECT_EQ(uncompress(raw.data(), &raw_size, &bytes[header_bytes], bytes.size() - header_bytes), Z_OK);
  change(raw);
  Bytes packed(compressBound(raw.size()));
  uLongf packed_size = packed.size();
  EXPECT_EQ(compress(packed.data(), &packed_size, raw.data(), raw.size()), Z_OK);
  bytes.resize(header_bytes);
  bytes.insert(bytes.end(), packed.begin(), packed.begin() + static_cast<std::ptrdiff_t>(packed_size));
  byte_io::put_u32(&bytes[at_raw_bytes], static_cast<std::uint32_t>(raw.size()));
  byte_io::put_u32(&bytes[at_packed_bytes], static_cast<std::uint32_t>(packed_size));
  fix_checksum(bytes);
  return bytes;
}

void expect_refused_weights(const Bytes& bytes, ErrorCode code, std::string_view where) {
  const auto result = decode_weights(bytes);
  ASSERT_FALSE(result.ok()) << where;
  EXPECT_EQ(result.error().code, code) << result.error().message;
  EXPECT_EQ(result.error().where, where);
}

TEST(WeightsFormat, Decode_InvalidHeader_IsRefusedByField) {
  const Bytes good = encode_weights(small_table());
  ASSERT_TRUE(decode_weights(good).ok());
  const auto changed = [&](std::size_t at, std::uint32_t value, int size) {
    Bytes bytes = good;
    for (int i = 0; i < size; ++i) {
      bytes[at + static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(value >> static_cast<unsigned>(8 * i));
    }
    fix_checksum(bytes);
    return bytes;
  };
  expect_refused_weights({}, ErrorCode::truncated, "header");
  expect_refused_weights(Bytes(good.begin(), good.begin() + 63), ErrorCode::truncated, "header");
  expect_refused_weights(changed(0, 'X', 1), ErrorCode::malformed, "magic");
  expect_refused_weights(changed(at_version, 4, 2), ErrorCode::unsupported, "version");
  expect_refused_weights(changed(at_version, 3, 2), ErrorCode::truncated, "turn");
  expect_refused_weights(changed(at_bits, 7, 1), ErrorCode::out_of_range, "bits");
  expect_refused_weights(changed(at_bits, 17, 1), ErrorCode::out_of_range, "bits");
  expect_refused_weights(changed(at_reserved, 1, 1), ErrorCode::malformed, "reserved");
  expect_refused_weights(changed(at_vertex_count, 0, 4), ErrorCode::empty, "vertex_count");
  expect_refused_weights(changed(at_vertex_count, 4'000'001, 4), ErrorCode::too_large, "vertex_count");
  expect_refused_weights(changed(at_entry_count, 48'000'001, 4), ErrorCode::too_large, "entry_count");
  expect_refused_weights(changed(at_entry_count, 12, 4), ErrorCode::mismatch, "entry_count");
  expect_refused_weights(changed(at_set_count, 0, 4), ErrorCode::out_of_range, "set_count");
  expect_refused_weights(changed(at_set_count, 10, 4), ErrorCode::out_of_range, "set_count");
  expect_refused_weights(changed(at_raw_bytes, 0xFFFFFFFF, 4), ErrorCode::malformed, "raw_bytes");
  expect_refused_weights(changed(at_raw_bytes, 10, 4), ErrorCode::malformed, "payload");
  expect_refused_weights(changed(at_packed_bytes, 0xFFFFFFFF, 4), ErrorCode::truncated, "payload");
  expect_refused_weights(changed(at_packed_bytes, 3, 4), ErrorCode::malformed, "payload");
  Bytes longer = good;
  longer.push_back(0);
  expect_refused_weights(longer, ErrorCode::malformed, "payload");
  Bytes other = good;
  other[at_mesh_sha256] ^= 1U;
  expect_refused_weights(other, ErrorCode::mismatch, "crc");
}

TEST(WeightsFormat, Decode_InvalidPayload_IsRefusedByField) {
  // Payload of small_table: sets {} x4, {1,7,30}=1 x2, then by content {1}, {1}=1, {1,50}:
  //   00 | 83 01 07 1E | 01 01 | 81 01 | 02 01 32 | 9 set ids | residuals in 2 planes | rigid 00 06 01 02 02 01
  const auto table = small_table();
  const auto changed = [&](std::size_t at, std::uint8_t value) {
    return with_payload(table, [&](Bytes& raw) { raw.at(at) = value; });
  };
  ASSERT_TRUE(decode_weights(changed(0, 0x00)).ok());
  expect_refused_weights(changed(0, 0x80), ErrorCode::malformed, "dictionary");   // nothing that sums to one
  expect_refused_weights(changed(0, 0x7F), ErrorCode::truncated, "dictionary");   // 127 points announced
  expect_refused_weights(changed(2, 0x07), ErrorCode::malformed, "dictionary");   // 7, 7: a point twice
  expect_refused_weights(changed(4, 84), ErrorCode::out_of_range, "dictionary");  // there are 84, from 0
  expect_refused_weights(changed(12, 5), ErrorCode::out_of_range, "set_ids");     // five sets: 0..4
  expect_refused_weights(with_payload(table, [](Bytes& raw) { raw[raw.size() - 2] = 3; }), ErrorCode::out_of_range,
                         "rigid");
  expect_refused_weights(with_payload(table, [](Bytes& raw) { raw.back() = 2; }), ErrorCode::out_of_range, "rigid");
  expect_refused_weights(with_payload(table, [](Bytes& raw) { raw.back() = 0; }), ErrorCode::out_of_range, "rigid");
  expect_refused_weights(with_payload(table, [](Bytes& raw) { raw.pop_back(); }), ErrorCode::truncated, "rigid");
  expect_refused_weights(with_payload(table, [](Bytes& raw) { raw.push_back(0); }), ErrorCode::malformed, "payload");
  // The high plane of the first residual: 12 bits leave no room above 0x0F.
  expect_refused_weights(with_payload(table, [](Bytes& raw) { raw.at(21 + 7) = 0x10; }), ErrorCode::out_of_range,
                         "weights");
}

TEST(WeightsFormat, Encode_PartsBeyondTheEyes_MakeVersion2) {
  InfluenceTable table = small_table();
  EXPECT_EQ(encode_weights(table)[at_version], 1);
  table.rigid = {0, 1, 2, 3, 4, 128, 200, 255, 255};
  const Bytes bytes = encode_weights(table);
  EXPECT_EQ(bytes[at_version], 2);
  const auto decoded = decode_weights(bytes);
  ASSERT_TRUE(decoded.ok()) << decoded.error().message;
  EXPECT_EQ(decoded->rigid, table.rigid);
  const auto changed = [&](std::uint8_t motion) {
    return with_payload(table, [&](Bytes& raw) { raw[raw.size() - 2] = motion; });
  };
  ASSERT_TRUE(decode_weights(changed(4)).ok());
  for (const int between : {5, 100, 127}) {
    expect_refused_weights(changed(static_cast<std::uint8_t>(between)), ErrorCode::out_of_range, "rigid");
  }
  Bytes as_version_1 = bytes;
  as_version_1[at_version] = 1;
  fix_checksum(as_version_1);
  expect_refused_weights(as_version_1, ErrorCode::out_of_range, "rigid");
}

TEST(WeightsFormat, Encode_LidsOrSharesOfTheHeadsRotation_MakeVersion3) {
  InfluenceTable turning = small_table();
  turning.turn.assign(turning.vertex_count, 255);
  EXPECT_EQ(encode_weights(turning)[at_version], 1) << "all turn fully, as without the table";
  turning.turn[3] = 0;
  turning.turn[4] = 128;
  const Bytes bytes = encode_weights(turning);
  EXPECT_EQ(bytes[at_version], 3);
  const auto decoded = decode_weights(bytes);
  ASSERT_TRUE(decoded.ok()) << decoded.error().message;
  EXPECT_EQ(decoded->turn, turning.turn);

  InfluenceTable lids = small_table();
  add_row(lids, {{14, 1.0F}}, static_cast<std::uint8_t>(RigidMotion::left_lids));
  const auto with_lids = decode_weights(encode_weights(lids));
  ASSERT_TRUE(with_lids.ok()) << with_lids.error().message;
  EXPECT_EQ(with_lids->rigid, lids.rigid);
  EXPECT_EQ(with_lids->turn, std::vector<std::uint8_t>(lids.vertex_count, 255));
  Bytes as_version_2 = encode_weights(lids);
  as_version_2[at_version] = 2;
  fix_checksum(as_version_2);
  expect_refused_weights(as_version_2, ErrorCode::out_of_range, "rigid");
}

TEST(WeightsFormat, Decode_EveryPrefix_IsRefused) {
  const Bytes good = encode_weights(smooth_table(500));
  for (std::size_t size = 0; size < good.size(); ++size) {
    ASSERT_FALSE(decode_weights(std::span(good).first(size)).ok()) << size;
  }
}

TEST(WeightsFormat, Decode_EveryFlippedBit_IsRefused) {
  Bytes bytes = encode_weights(small_table());
  for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
    bytes[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    ASSERT_FALSE(decode_weights(bytes).ok()) << "bit " << bit;
    bytes[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
  }
}

TEST(WeightsFormat, Decode_FlippedPayloadBytesWithRightChecksums_NeverGivesAnInvalidTable) {
  const auto table = small_table();
  std::mt19937 random(1);
  for (int round = 0; round < 2000; ++round) {
    const Bytes bytes = with_payload(table, [&](Bytes& raw) {
      for (unsigned i = 0; i < 1 + random() % 3; ++i) raw[random() % raw.size()] = static_cast<std::uint8_t>(random());
    });
    const auto result = decode_weights(bytes);
    if (!result) continue;
    ASSERT_EQ(result->rows.row_count(), result->vertex_count);
    ASSERT_EQ(result->rigid.size(), result->vertex_count);
    for (const auto point : result->rows.points) ASSERT_LT(point.value(), feature_point_count);
    for (const float weight : result->rows.weights) ASSERT_TRUE(weight >= 0.0F && weight <= 1.0F);
  }
}

TEST(WeightsFormat, Decode_RandomBytes_IsRefused) {
  std::mt19937 random(2);
  for (int round = 0; round < 2000; ++round) {
    Bytes bytes(random() % 300);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    ASSERT_FALSE(decode_weights(bytes).ok());
  }
}

class WeightsFormatBits : public testing::TestWithParam<int> {};

TEST_P(WeightsFormatBits, RoundTrip_KeepsPointsAndRigid_AndWeightsWithinOneStep) {
  const int bits = GetParam();
  for (const InfluenceTable& table : {small_table(), smooth_table(3000)}) {
    const auto decoded = decode_weights(encode_weights(table, {bits}));
    ASSERT_TRUE(decoded.ok()) << decoded.error().message;
    EXPECT_EQ(decoded->vertex_count, table.vertex_count);
    EXPECT_EQ(decoded->mesh_sha256, table.mesh_sha256);
    EXPECT_EQ(decoded->rows.offsets, table.rows.offsets);
    EXPECT_EQ(decoded->rows.points, table.rows.points);
    EXPECT_EQ(decoded->rigid, table.rigid);
    // Largest remainder moves a weight by less than one step; plain rounding by half of one.
    EXPECT_LT(max_quantization_error(table, *decoded), 1.0 / ((1 << bits) - 1) + 1e-6);
  }
}

TEST_P(WeightsFormatBits, RoundTrip_RowsThatSumToOne_SumToOneInLevels) {
  const int bits = GetParam();
  const double total = (1 << bits) - 1;
  const auto table = smooth_table(2000);
  const auto decoded = decode_weights(encode_weights(table, {bits}));
  ASSERT_TRUE(decoded.ok());
  for (std::size_t v = 0; v < decoded->vertex_count; ++v) {
    long levels = 0;
    for (const float weight : decoded->rows.weights_of(v)) levels += std::lround(weight * total);
    ASSERT_EQ(levels, std::lround(total)) << v;
  }
}

INSTANTIATE_TEST_SUITE_P(Widths, WeightsFormatBits, testing::Values(8, 9, 12, 15, 16));

TEST(WeightsFormat, RoundTrip_ManySets_NeedTwoPlanesOfIds) {
  InfluenceTable table;
  for (int a = 0; a < 84; ++a) {
    for (int b = a + 1; b < 84; ++b) add_row(table, {{a, 0.5F}, {b, 0.5F}});
  }
  const Bytes bytes = encode_weights(table);
  EXPECT_EQ(byte_io::get_u32(&bytes[at_set_count]), 84U * 83U / 2U);
  const auto decoded = decode_weights(bytes);
  ASSERT_TRUE(decoded.ok()) << decoded.error().message;
  EXPECT_EQ(decoded->rows.points, table.rows.points);
}

TEST(WeightsFormat, Encode_LargestRemainder_ByHand) {
  // 8 bits: 255 levels. 1/3 each: 85 85 85, nothing left over.
  InfluenceTable table;
  add_row(table, {{1, 1.0F / 3}, {2, 1.0F / 3}, {3, 1.0F / 3}});
  add_row(table, {{1, 0.5F}, {2, 0.25F}, {3, 0.25F}});
  const auto decoded = decode_weights(encode_weights(table, {8}));
  ASSERT_TRUE(decoded.ok());
  // 0.5 -> 127.5, 0.25 -> 63.75 twice: 127 + 63 + 63 = 253, two to give to the remainders 0.75, 0.75.
  const std::vector<float> expected = {85.0F / 255, 85.0F / 255, 85.0F / 255, 127.0F / 255, 64.0F / 255, 64.0F / 255};
  EXPECT_EQ(decoded->rows.weights, expected);
}

TEST(WeightsFormat, Encode_SameTable_GivesSameBytes) {
  EXPECT_EQ(encode_weights(smooth_table(1000)), encode_weights(smooth_table(1000)));
}

}  // namespace
}  // namespace semblante

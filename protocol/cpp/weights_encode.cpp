#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>
#include <zlib.h>

#include "core/types/moving_parts.h"
#include "protocol/cpp/byte_io.h"
#include "protocol/cpp/weights_format.h"
#include "protocol/cpp/weights_layout.h"

namespace semblante {
namespace {

using namespace weights_layout;

/// One entry of the dictionary: the points that move a vertex, and whether its weights sum to one.
struct OrderedInfluenceSet {
  std::vector<std::uint16_t> points;  ///< dense indices; not bytes, whose comparison GCC 12 warns of for no reason
  bool unit_sum = false;
  bool operator<(const OrderedInfluenceSet& other) const {
    return std::tie(points, unit_sum) < std::tie(other.points, other.unit_sum);
  }
};

struct Quantized {
  std::vector<std::uint32_t> levels;  ///< #entries, 0..2^bits-1
  std::vector<bool> unit_sum;         ///< #V
};

bool sums_to_one(std::span<const float> row) {
  return !row.empty() && std::abs(std::accumulate(row.begin(), row.end(), 0.0) - 1.0) <= 1e-5;
}

/// Largest remainder method: integer parts first, then one more for the largest remainders, so the sum is `total`.
void quantize_unit_row(std::span<const float> row, std::uint32_t total, std::uint32_t* levels) {
  const double scale = total / std::accumulate(row.begin(), row.end(), 0.0);
  std::vector<std::pair<double, std::size_t>> remainders;
  remainders.reserve(row.size());
  std::uint32_t given = 0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const double exact = static_cast<double>(row[i]) * scale;
    levels[i] = std::min(static_cast<std::uint32_t>(exact), total - given);
    given += levels[i];
    remainders.emplace_back(exact - levels[i], i);
  }
  std::stable_sort(remainders.begin(), remainders.end(), [](auto& a, auto& b) { return a.first > b.first; });
  for (std::size_t i = 0; given < total; i = (i + 1) % row.size(), ++given) ++levels[remainders[i].second];
}

Quantized quantize_rows(const WeightTable<float>& rows, int bits) {
  const std::uint32_t total = (1U << static_cast<unsigned>(bits)) - 1U;
  Quantized result;
  result.levels.resize(rows.weights.size());
  result.unit_sum.resize(rows.row_count());
  for (std::size_t v = 0; v < rows.row_count(); ++v) {
    const auto row = rows.weights_of(v);
    std::uint32_t* levels = result.levels.data() + rows.offsets[v];
    result.unit_sum[v] = sums_to_one(row);
    if (result.unit_sum[v]) {
      quantize_unit_row(row, total, levels);
    } else {
      for (std::size_t i = 0; i < row.size(); ++i) {
        levels[i] = static_cast<std::uint32_t>(std::lround(static_cast<double>(row[i]) * total));
      }
    }
  }
  return result;
}

struct Dictionary {
  std::vector<OrderedInfluenceSet> sets;  ///< most used first; ties by content, so that equal tables give equal bytes
  std::vector<std::uint32_t> set_of_vertex;
};

Dictionary build_dictionary(const WeightTable<float>& rows, const std::vector<bool>& unit_sum) {
  std::map<OrderedInfluenceSet, std::vector<std::uint32_t>> vertices_of;
  for (std::size_t v = 0; v < rows.row_count(); ++v) {
    const auto points = rows.points_of(v);
    OrderedInfluenceSet set;
    set.unit_sum = unit_sum[v];
    for (const FeaturePointId point : points) set.points.push_back(point.value());
    vertices_of[std::move(set)].push_back(static_cast<std::uint32_t>(v));
  }
  std::vector<const std::pair<const OrderedInfluenceSet, std::vector<std::uint32_t>>*> order;
  order.reserve(vertices_of.size());
  for (const auto& entry : vertices_of) order.push_back(&entry);
  std::stable_sort(order.begin(), order.end(), [](auto a, auto b) { return a->second.size() > b->second.size(); });

  Dictionary result;
  result.set_of_vertex.resize(rows.row_count());
  for (const auto* entry : order) {
    for (const std::uint32_t v : entry->second) {
      result.set_of_vertex[v] = static_cast<std::uint32_t>(result.sets.size());
    }
    result.sets.push_back(entry->first);
  }
  return result;
}

void append_planes(std::vector<std::uint8_t>& to, std::span<const std::uint32_t> values, int planes) {
  for (int plane = 0; plane < planes; ++plane) {
    for (const std::uint32_t value : values) {
      to.push_back(static_cast<std::uint8_t>(value >> (8U * static_cast<unsigned>(plane))));
    }
  }
}

/// Predicts each weight by that of the last vertex with the same set, usually a neighbour in the mesh.
std::vector<std::uint32_t> residuals(const WeightTable<float>& rows, const Quantized& quantized,
                                     const Dictionary& dictionary, int bits) {
  std::vector<std::vector<std::uint32_t>> last(dictionary.sets.size());
  std::vector<std::uint32_t> result;
  for (std::size_t v = 0; v < rows.row_count(); ++v) {
    const std::size_t count = rows.points_of(v).size();
    auto& prediction = last[dictionary.set_of_vertex[v]];
    prediction.resize(count);
    const std::uint32_t* levels = quantized.levels.data() + rows.offsets[v];
    for (std::size_t i = 0; i < count - (quantized.unit_sum[v] ? 1 : 0); ++i) {
      result.push_back(fold(levels[i], prediction[i], bits));
      prediction[i] = levels[i];
    }
  }
  return result;
}

std::uint16_t lowest_version(const InfluenceTable& table) {
  const bool all_turn =
      std::all_of(table.turn.begin(), table.turn.end(), [](std::uint8_t t) { return t == full_turn; });
  for (const std::uint16_t version : {version_of_eyes, version_of_parts}) {
    const auto is_known = [version](std::uint8_t motion) { return has_motion(version, motion); };
    if (all_turn && std::all_of(table.rigid.begin(), table.rigid.end(), is_known)) return version;
  }
  return version_of_turns;
}

/// The differences between the shares of consecutive vertices, which are neighbours.
void append_turns(std::vector<std::uint8_t>& payload, const InfluenceTable& table) {
  std::uint8_t last = full_turn;
  for (std::uint32_t v = 0; v < table.vertex_count; ++v) {
    const std::uint8_t turn = table.turn.empty() ? full_turn : table.turn[v];
    payload.push_back(static_cast<std::uint8_t>(turn - last));
    last = turn;
  }
}

std::vector<std::uint8_t> build_payload(const InfluenceTable& table, const Quantized& quantized,
                                        const Dictionary& dictionary, int bits, std::uint16_t version) {
  std::vector<std::uint8_t> payload;
  for (const OrderedInfluenceSet& set : dictionary.sets) {
    payload.push_back(static_cast<std::uint8_t>(set.points.size() | (set.unit_sum ? unit_sum_flag : 0U)));
    for (const std::uint16_t point : set.points) payload.push_back(static_cast<std::uint8_t>(point));
  }
  append_planes(payload, dictionary.set_of_vertex, id_planes(static_cast<std::uint32_t>(dictionary.sets.size())));
  append_planes(payload, residuals(table.rows, quantized, dictionary, bits), weight_planes(bits));
  for (std::size_t v = 0; v < table.rigid.size();) {
    std::size_t end = v + 1;
    while (end < table.rigid.size() && table.rigid[end] == table.rigid[v]) ++end;
    payload.push_back(table.rigid[v]);
    byte_io::append_varint(payload, end - v);
    v = end;
  }
  if (version == version_of_turns) append_turns(payload, table);
  return payload;
}

void assert_consistent([[maybe_unused]] const InfluenceTable& table) {
#ifndef NDEBUG
  assert(table.vertex_count > 0 && table.vertex_count <= max_weights_vertices);
  assert(table.rows.row_count() == table.vertex_count && table.rigid.size() == table.vertex_count);
  assert(table.turn.empty() || table.turn.size() == table.vertex_count);
  assert(table.rows.points.size() == table.rows.weights.size() && table.rows.points.size() <= max_weights_entries);
  for (std::size_t v = 0; v < table.vertex_count; ++v) {
    const auto points = table.rows.points_of(v);
    assert(std::adjacent_find(points.begin(), points.end(), std::greater_equal<>()) == points.end());
    assert(points.empty() || points.back().value() < feature_point_count);
    assert(is_rigid_motion(table.rigid[v]));
  }
  for (const float weight : table.rows.weights) assert(weight >= 0.0F && weight <= 1.0F);
#endif
}

}  // namespace

std::vector<std::uint8_t> encode_weights(const InfluenceTable& table, const WeightsEncoding& encoding) {
  assert(encoding.bits >= min_bits && encoding.bits <= max_bits);
  assert_consistent(table);
  const Quantized quantized = quantize_rows(table.rows, encoding.bits);
  const Dictionary dictionary = build_dictionary(table.rows, quantized.unit_sum);
  const std::uint16_t version = lowest_version(table);
  const std::vector<std::uint8_t> payload = build_payload(table, quantized, dictionary, encoding.bits, version);

  std::vector<std::uint8_t> bytes(header_bytes + compressBound(payload.size()));
  uLongf packed = bytes.size() - header_bytes;
  const int status =
      compress2(bytes.data() + header_bytes, &packed, payload.data(), payload.size(), Z_BEST_COMPRESSION);
  if (status != Z_OK) std::abort();  // the buffer is compressBound() long, so the only possible error is out of memory
  bytes.resize(header_bytes + packed);

  std::memcpy(bytes.data(), magic, sizeof(magic));
  byte_io::put_u16(&bytes[at_version], version);
  bytes[at_bits] = static_cast<std::uint8_t>(encoding.bits);
  byte_io::put_u32(&bytes[at_vertex_count], table.vertex_count);
  byte_io::put_u32(&bytes[at_set_count], static_cast<std::uint32_t>(dictionary.sets.size()));
  byte_io::put_u32(&bytes[at_entry_count], static_cast<std::uint32_t>(table.rows.points.size()));
  byte_io::put_u32(&bytes[at_raw_bytes], static_cast<std::uint32_t>(payload.size()));
  byte_io::put_u32(&bytes[at_packed_bytes], static_cast<std::uint32_t>(packed));
  std::copy(table.mesh_sha256.begin(), table.mesh_sha256.end(), bytes.begin() + at_mesh_sha256);
  byte_io::put_u32(&bytes[at_crc], static_cast<std::uint32_t>(crc32_z(0, bytes.data(), bytes.size())));
  return bytes;
}

double max_quantization_error(const InfluenceTable& table, const InfluenceTable& decoded) {
  assert(table.rows.points == decoded.rows.points && table.rows.offsets == decoded.rows.offsets);
  double worst = 0.0;
  for (std::size_t i = 0; i < table.rows.weights.size(); ++i) {
    worst = std::max(worst, std::abs(static_cast<double>(table.rows.weights[i]) - decoded.rows.weights[i]));
  }
  return worst;
}

}  // namespace semblante

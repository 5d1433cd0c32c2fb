#include <algorithm>
#include <array>
#include <cstring>
#include <string>

#include "core/types/decimal.h"
#include "core/types/moving_parts.h"
#include "protocol/cpp/byte_io.h"
#include "protocol/cpp/inflate.h"
#include "protocol/cpp/weights_format.h"
#include "protocol/cpp/weights_layout.h"

namespace semblante {
namespace {

using namespace weights_layout;

/// Maximum expansion of deflate: a larger declared size is refused before memory is allocated.
constexpr std::uint64_t max_inflation = 1032;

struct Header {
  std::uint16_t version = 0;
  int bits = 0;
  std::uint32_t vertex_count = 0;
  std::uint32_t set_count = 0;
  std::uint32_t entry_count = 0;
  std::uint32_t raw_bytes = 0;
  std::uint32_t packed_bytes = 0;
};

/// Clients carry this file: an error takes little room in each of its many places, and no step hands on an object.
[[gnu::noinline]] bool fail(Error& fault, ErrorCode code, const char* where, const char* message,
                            const std::string& more = {}) {
  fault = {code, where, "weights: " + (message + more)};
  return false;
}
[[gnu::noinline]] bool fail(Error& fault, ErrorCode code, const char* where, const char* before, std::uint64_t number,
                            const char* after = "") {
  return fail(fault, code, where, before, natural_text(number) + after);
}

std::uint32_t checksum(std::span<const std::uint8_t> bytes) {
  static constexpr std::array<std::uint8_t, 4> zero{};
  return crc32(crc32(crc32(0, bytes.first(at_crc)), zero), bytes.subspan(at_crc + zero.size()));
}

bool read_header(std::span<const std::uint8_t> bytes, Header& header, Error& fault) {
  if (bytes.size() < header_bytes)
    return fail(fault, ErrorCode::truncated, "header", "shorter than its header of 64 bytes");
  if (std::memcmp(bytes.data(), magic, sizeof(magic)) != 0)
    return fail(fault, ErrorCode::malformed, "magic", "not SBWT");
  const std::uint16_t file_version = byte_io::get_u16(&bytes[at_version]);
  if (file_version < version_of_eyes || file_version > version_of_turns) {
    return fail(fault, ErrorCode::unsupported, "version", "version ", file_version, ", only 1 to 3 are known");
  }
  header.version = file_version;
  header.bits = bytes[at_bits];
  header.vertex_count = byte_io::get_u32(&bytes[at_vertex_count]);
  header.set_count = byte_io::get_u32(&bytes[at_set_count]);
  header.entry_count = byte_io::get_u32(&bytes[at_entry_count]);
  header.raw_bytes = byte_io::get_u32(&bytes[at_raw_bytes]);
  header.packed_bytes = byte_io::get_u32(&bytes[at_packed_bytes]);

  if (header.bits < min_bits || header.bits > max_bits)
    return fail(fault, ErrorCode::out_of_range, "bits", "not 8..16");
  if (bytes[at_reserved] != 0) return fail(fault, ErrorCode::malformed, "reserved", "not zero");
  if (header.vertex_count == 0) return fail(fault, ErrorCode::empty, "vertex_count", "no vertices");
  if (header.vertex_count > max_weights_vertices)
    return fail(fault, ErrorCode::too_large, "vertex_count", "over 4000000");
  if (header.entry_count > max_weights_entries)
    return fail(fault, ErrorCode::too_large, "entry_count", "over 48000000");
  if (header.set_count == 0 || header.set_count > header.vertex_count || header.set_count > max_set_count) {
    return fail(fault, ErrorCode::out_of_range, "set_count", "not between 1 and the number of vertices");
  }
  if (header.packed_bytes > bytes.size() - header_bytes) {
    return fail(fault, ErrorCode::truncated, "payload", "ends before the declared size");
  }
  if (header.packed_bytes < bytes.size() - header_bytes) {
    return fail(fault, ErrorCode::malformed, "payload", "bytes after the declared size");
  }
  if (header.raw_bytes > max_inflation * header.packed_bytes) {
    return fail(fault, ErrorCode::malformed, "raw_bytes", "more than the packed bytes can hold");
  }
  if (checksum(bytes) != byte_io::get_u32(&bytes[at_crc]))
    return fail(fault, ErrorCode::mismatch, "crc", "checksum differs");
  return true;
}

struct InfluenceSetView {
  std::span<const std::uint8_t> points;
  bool unit_sum = false;
  std::uint32_t first = 0;  ///< of its stored weights among those of all sets
  [[nodiscard]] std::size_t stored() const { return points.size() - (unit_sum ? 1 : 0); }
};

bool read_dictionary(byte_io::Reader& reader, std::uint32_t set_count, std::vector<InfluenceSetView>& sets,
                     Error& fault) {
  if (set_count > reader.remaining()) return fail(fault, ErrorCode::truncated, "set_count", "more sets than bytes");
  sets.resize(set_count);
  std::uint32_t stored = 0;
  for (InfluenceSetView& set : sets) {
    const std::uint8_t first = reader.u8();
    set.unit_sum = (first & unit_sum_flag) != 0;
    set.points = reader.take(first & ~unit_sum_flag & 0xFFU);
    if (reader.failed()) return fail(fault, ErrorCode::truncated, "dictionary", "ends early");
    if (set.unit_sum && set.points.empty())
      return fail(fault, ErrorCode::malformed, "dictionary", "an empty set cannot sum to one");
    if (std::adjacent_find(set.points.begin(), set.points.end(), std::greater_equal<>()) != set.points.end()) {
      return fail(fault, ErrorCode::malformed, "dictionary", "the points of a set are not increasing");
    }
    if (!set.points.empty() && set.points.back() >= feature_point_count) {
      return fail(fault, ErrorCode::out_of_range, "dictionary", "no feature point ", set.points.back());
    }
    set.first = stored;
    stored += static_cast<std::uint32_t>(set.stored());
  }
  return true;
}

std::uint32_t from_planes(std::span<const std::uint8_t> planes, std::size_t count, std::size_t index) {
  std::uint32_t value = 0;
  for (std::size_t at = index, shift = 0; at < planes.size(); at += count, shift += 8) {
    value |= static_cast<std::uint32_t>(planes[at]) << shift;
  }
  return value;
}

bool read_set_ids(byte_io::Reader& reader, const Header& header, const std::vector<InfluenceSetView>& sets,
                  std::vector<std::uint32_t>& ids, Error& fault) {
  const auto planes =
      reader.take(std::size_t{header.vertex_count} * static_cast<std::size_t>(id_planes(header.set_count)));
  if (reader.failed()) return fail(fault, ErrorCode::truncated, "set_ids", "ends early");
  ids.resize(header.vertex_count);
  std::uint64_t entries = 0;
  for (std::size_t v = 0; v < ids.size(); ++v) {
    ids[v] = from_planes(planes, ids.size(), v);
    if (ids[v] >= sets.size()) return fail(fault, ErrorCode::out_of_range, "set_ids", "vertex ", v);
    entries += sets[ids[v]].points.size();
  }
  if (entries != header.entry_count) {
    return fail(fault, ErrorCode::mismatch, "entry_count", "the sets hold ", entries);
  }
  return true;
}

bool read_rows(byte_io::Reader& reader, const Header& header, const std::vector<InfluenceSetView>& sets,
               const std::vector<std::uint32_t>& ids, WeightTable<float>& rows, Error& fault) {
  std::size_t stored = 0;
  for (const std::uint32_t id : ids) stored += sets[id].stored();
  const auto planes = reader.take(stored * static_cast<std::size_t>(weight_planes(header.bits)));
  if (reader.failed()) return fail(fault, ErrorCode::truncated, "weights", "ends early");

  const std::uint32_t total = (1U << static_cast<unsigned>(header.bits)) - 1U;
  std::vector<std::uint32_t> last(sets.back().first + sets.back().stored());
  rows.offsets.resize(ids.size() + 1);
  rows.points.resize(header.entry_count);
  rows.weights.resize(header.entry_count);
  std::size_t entry = 0;
  for (std::size_t v = 0, at = 0; v < ids.size(); ++v) {
    const InfluenceSetView& set = sets[ids[v]];
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < set.points.size(); ++i, ++entry) {
      std::uint32_t level = total - sum;
      if (i < set.stored()) {
        const std::uint32_t folded = from_planes(planes, stored, at++);
        if (folded > total) return fail(fault, ErrorCode::out_of_range, "weights", "vertex ", v);
        std::uint32_t& prediction = last[set.first + i];
        level = prediction = unfold(folded, prediction, header.bits);
      }
      sum += level;
      if (set.unit_sum && sum > total) {
        return fail(fault, ErrorCode::out_of_range, "weights", "vertex ", v, " sums to more than one");
      }
      rows.points[entry] = FeaturePointId(set.points[i]);
      rows.weights[entry] = static_cast<float>(level) / static_cast<float>(total);
    }
    rows.offsets[v + 1] = static_cast<std::uint32_t>(entry);
  }
  return true;
}

bool read_rigid(byte_io::Reader& reader, const Header& header, std::vector<std::uint8_t>& rigid, Error& fault) {
  const std::uint32_t vertex_count = header.vertex_count;
  rigid.resize(vertex_count);
  for (std::size_t v = 0; v < vertex_count;) {
    const std::uint8_t motion = reader.u8();
    const std::uint64_t run = reader.varint();
    if (reader.failed()) return fail(fault, ErrorCode::truncated, "rigid", "ends early");
    if (!is_rigid_motion(motion) || !has_motion(header.version, motion)) {
      return fail(fault, ErrorCode::out_of_range, "rigid", "unknown rigid motion");
    }
    if (run == 0 || run > vertex_count - v)
      return fail(fault, ErrorCode::out_of_range, "rigid", "invalid length of a run");
    std::memset(&rigid[v], motion, static_cast<std::size_t>(run));
    v += static_cast<std::size_t>(run);
  }
  return true;
}

bool read_turns(byte_io::Reader& reader, const Header& header, std::vector<std::uint8_t>& turns, Error& fault) {
  if (header.version != version_of_turns) return true;
  const auto differences = reader.take(header.vertex_count);
  if (reader.failed()) return fail(fault, ErrorCode::truncated, "turn", "ends early");
  turns.resize(differences.size());
  std::uint8_t last = full_turn;
  for (std::size_t v = 0; v < turns.size(); ++v) {
    last = static_cast<std::uint8_t>(last + differences[v]);
    turns[v] = last;
  }
  return true;
}

bool read(std::span<const std::uint8_t> bytes, InfluenceTable& table, Error& fault) {
  Header header;
  if (!read_header(bytes, header, fault)) return false;
  std::vector<std::uint8_t> payload(header.raw_bytes);
  if (!inflate_zlib(bytes.subspan(header_bytes), payload)) {
    return fail(fault, ErrorCode::malformed, "payload", "not a zlib stream of the declared size");
  }
  byte_io::Reader reader(payload);
  std::vector<InfluenceSetView> sets;
  std::vector<std::uint32_t> ids;
  table.vertex_count = header.vertex_count;
  std::copy_n(bytes.begin() + at_mesh_sha256, table.mesh_sha256.size(), table.mesh_sha256.begin());
  if (!read_dictionary(reader, header.set_count, sets, fault) || !read_set_ids(reader, header, sets, ids, fault) ||
      !read_rows(reader, header, sets, ids, table.rows, fault) || !read_rigid(reader, header, table.rigid, fault) ||
      !read_turns(reader, header, table.turn, fault)) {
    return false;
  }
  if (reader.remaining() != 0) return fail(fault, ErrorCode::malformed, "payload", "bytes after the last field");
  return true;
}

}  // namespace

Result<InfluenceTable> decode_weights(std::span<const std::uint8_t> bytes) {
  InfluenceTable table;
  Error fault;
  if (!read(bytes, table, fault)) return fault;
  return table;
}

}  // namespace semblante

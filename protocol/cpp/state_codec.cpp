#include "protocol/cpp/state_codec.h"

#include "core/tables/mpeg4.h"
#include "protocol/cpp/generated/messages.h"

namespace semblante {
namespace {

constexpr std::uint32_t viseme_bit = 1U << 0U;
constexpr std::uint32_t expression_bit = 1U << 1U;
constexpr std::uint32_t known_bits = (1U << 11U) - 1U;  // viseme, expression, FAP groups 2..10 by number
constexpr int level_limit = static_cast<int>(max_level);

constexpr std::uint32_t bit_of(const mpeg4::FapGroup& group) { return 1U << group.number; }

/// Mask of the FAPs of a group that differ; bit 0 is the first FAP of the group.
std::uint32_t changes(const mpeg4::FapGroup& group, const FaceFrame& from, const FaceFrame& state) {
  std::uint32_t mask = 0;
  for (std::size_t fap = group.first_fap; fap <= group.last_fap; ++fap) {
    if (from.level[fap] != state.level[fap]) mask |= 1U << (fap - group.first_fap);
  }
  return mask;
}

constexpr std::uint32_t zigzag(std::int32_t value) {
  return (static_cast<std::uint32_t>(value) << 1U) ^ (value < 0 ? ~0U : 0U);
}
constexpr std::int64_t unzigzag(std::uint64_t value) {
  return static_cast<std::int64_t>(value >> 1U) ^ -static_cast<std::int64_t>(value & 1U);
}

Status read_bounded(byte_io::Reader& reader, std::uint8_t& value, std::uint8_t most, const std::string& where) {
  value = reader.u8();
  if (!reader.failed() && value > most) {
    return Error{ErrorCode::out_of_range, where,
                 "must be between 0 and " + std::to_string(most) + ", not " + std::to_string(value)};
  }
  return Unit{};
}

Status read_group(byte_io::Reader& reader, const mpeg4::FapGroup& group, FaceFrame& state, const std::string& where) {
  const std::uint64_t mask = reader.varint();
  const unsigned size = group.last_fap - group.first_fap + 1U;
  if (reader.failed()) return Unit{};
  if (mask == 0 || mask >> size != 0) {
    return Error{ErrorCode::out_of_range, where + "/faps", "a mask is zero or has bits outside its group"};
  }
  for (unsigned i = 0; i < size; ++i) {
    if ((mask >> i & 1U) == 0) continue;
    const std::size_t fap = group.first_fap + i;
    const std::uint64_t difference = reader.varint();
    // Levels are within +-32767, so a difference has at most 17 bits.
    const std::int64_t level = state.level[fap] + (difference >> 17U != 0 ? 2 * level_limit + 1 : unzigzag(difference));
    if (level < -level_limit || level > level_limit) {
      return Error{ErrorCode::out_of_range, where + "/faps/" + std::to_string(fap), "beyond 32767 levels"};
    }
    state.level[fap] = static_cast<std::int16_t>(level);
  }
  return Unit{};
}

Status read_high_level(byte_io::Reader& reader, std::uint64_t bits, FaceFrame& state, const std::string& where) {
  struct Member {
    std::uint8_t& value;
    const char* name;
    std::uint32_t bit;
    std::uint8_t most;
  };
  const Member members[] = {
      {state.viseme.select1, "/viseme/select1", viseme_bit, max_viseme},
      {state.viseme.select2, "/viseme/select2", viseme_bit, max_viseme},
      {state.viseme.blend, "/viseme/blend", viseme_bit, max_blend},
      {state.expression.select1, "/expression/select1", expression_bit, max_expression},
      {state.expression.intensity1, "/expression/intensity1", expression_bit, max_blend},
      {state.expression.select2, "/expression/select2", expression_bit, max_expression},
      {state.expression.intensity2, "/expression/intensity2", expression_bit, max_blend},
  };
  for (const Member& member : members) {
    if ((bits & member.bit) == 0) continue;
    if (auto status = read_bounded(reader, member.value, member.most, where + member.name); !status) return status;
  }
  return Unit{};
}

}  // namespace

void append_state(std::vector<std::uint8_t>& to, const FaceFrame& from, const FaceFrame& state) {
  std::uint32_t bits = 0;
  if (from.viseme != state.viseme) bits |= viseme_bit;
  if (from.expression != state.expression) bits |= expression_bit;
  for (const auto& group : mpeg4::fap_groups) {
    if (group.number > 1 && changes(group, from, state) != 0) bits |= bit_of(group);
  }
  byte_io::append_varint(to, bits);
  if ((bits & viseme_bit) != 0) {
    to.insert(to.end(), {state.viseme.select1, state.viseme.select2, state.viseme.blend});
  }
  if ((bits & expression_bit) != 0) {
    to.insert(to.end(), {state.expression.select1, state.expression.intensity1, state.expression.select2,
                         state.expression.intensity2});
  }
  for (const auto& group : mpeg4::fap_groups) {
    if (group.number == 1 || (bits & bit_of(group)) == 0) continue;
    const std::uint32_t mask = changes(group, from, state);
    byte_io::append_varint(to, mask);
    for (std::size_t fap = group.first_fap; fap <= group.last_fap; ++fap) {
      if ((mask >> (fap - group.first_fap) & 1U) != 0) {
        byte_io::append_varint(to, zigzag(state.level[fap] - from.level[fap]));
      }
    }
  }
}

Status read_state(byte_io::Reader& reader, FaceFrame& state, const std::string& where) {
  const std::uint64_t bits = reader.varint();
  if (!reader.failed() && (bits & ~std::uint64_t{known_bits}) != 0) {
    return Error{ErrorCode::unsupported, where, "bits of a later version"};
  }
  if (auto status = read_high_level(reader, bits, state, where); !status) return status;
  for (const auto& group : mpeg4::fap_groups) {
    if (group.number == 1 || (bits & bit_of(group)) == 0) continue;
    if (auto status = read_group(reader, group, state, where); !status) return status;
  }
  if (reader.failed()) return Error{ErrorCode::truncated, where, "the message ends within a state"};
  return Unit{};
}

bool is_valid(const FaceFrame& state) {
  const auto& [viseme, expression, level] = state;
  if (viseme.select1 > max_viseme || viseme.select2 > max_viseme || viseme.blend > max_blend) return false;
  if (expression.select1 > max_expression || expression.select2 > max_expression) return false;
  if (expression.intensity1 > max_blend || expression.intensity2 > max_blend) return false;
  for (const std::int16_t value : level) {
    if (value < -level_limit) return false;
  }
  return true;
}

}  // namespace semblante

#pragma once

#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "core/types/result.h"
#include "protocol/cpp/generated/packed_tables.h"
#include "protocol/cpp/messages.h"
#include "protocol/cpp/packed_state.h"

/// The binary form of keyframes and frames: predicted and entropy coded. SPEC.md, "Packed form".
namespace semblante {

/// Probabilities of a 1 in 4096ths, by context.
using PackedTable = std::array<std::uint16_t, packed_tables::size>;

/// Encodes a stream in the packed form. A value of some 650 bytes: a copy continues independently from the copied
/// state, and produces the same bytes from the same frames.
class PackedEncoder {
 public:
  /// `start`: the state before the first frame (default: the neutral face). `table`, which must outlive the encoder, is
  /// for measurements: decoders use the standard one only.
  explicit PackedEncoder(const Keyframe& start = {}, const PackedTable& table = packed_tables::values);

  /// Asserts that the message is within the documented ranges and follows without a gap (`sequence` 0 means the next).
  std::vector<std::uint8_t> encode(const Frames& frames);
  /// Appends to `to`.
  void encode(const Frames& frames, std::vector<std::uint8_t>& to);

  /// A keyframe: the newest frame and the codec state that a decoder needs for the next result of encode(). Valid for
  /// decoders that have read the stream from the start and for those that join now.
  [[nodiscard]] std::vector<std::uint8_t> keyframe() const;

  /// Sequence number of the newest frame.
  [[nodiscard]] std::uint64_t sequence() const { return state_.sequence; }
  [[nodiscard]] std::uint64_t media_time() const { return state_.media_time; }
  [[nodiscard]] const FaceFrame& state() const { return state_.before[0]; }

 private:
  PackedState state_;
  const PackedTable* table_;
};

/// Whether messages of a type are coded by this file.
template <class M>
inline constexpr bool is_packed = std::is_same_v<M, Keyframe> || std::is_same_v<M, Frames>;

/// What a message is, by its first byte. That of `frames` has the low seven bits of their first number added.
constexpr bool is_keyframe(std::uint8_t type) { return type == MessageTraits<Keyframe>::type; }
constexpr bool is_frames(std::uint8_t type) { return type >= MessageTraits<Frames>::type; }

/// Decodes a whole message, including its type, from untrusted bytes. Time and memory are bounded by the number of
/// frames, at most 1024. Errors have the pointer of the JSON form and leave `state` unchanged.
/// `mismatch` at "/sequence": the frames do not follow `state`.
Result<Keyframe> read_packed_keyframe(std::span<const std::uint8_t> bytes, PackedState& state,
                                      const PackedTable& table = packed_tables::values);
/// `frames` has no meaning after an error; its memory is used again.
Status read_packed_frames(std::span<const std::uint8_t> bytes, PackedState& state, Frames& frames,
                          const PackedTable& table = packed_tables::values);

}  // namespace semblante

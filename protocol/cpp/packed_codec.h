#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/types/result.h"
#include "protocol/cpp/generated/packed_tables.h"
#include "protocol/cpp/messages.h"
#include "protocol/cpp/packed_state.h"

/// The packed form of keyframes and frames: predicted and entropy coded. SPEC.md, "Packed form".
namespace semblante {

/// Probabilities of a 1 in 4096ths, by context.
using PackedTable = std::array<std::uint16_t, packed_tables::size>;

/// Writes a stream in the packed form. A value of some 650 bytes: a copy goes on from where it was taken, on its own,
/// and makes the same bytes from the same frames.
class PackedEncoder {
 public:
  /// Begins at a state (the neutral face before the first frame). `table`, which must outlive it, is for measurements:
  /// readers know the standard one only.
  explicit PackedEncoder(const Keyframe& start = {}, const PackedTable& table = packed_tables::values);

  /// Asserts that the message is within the documented ranges and follows without a gap (`sequence` 0 does).
  std::vector<std::uint8_t> encode(const Frames& frames);

  /// The newest frame and all that a reader must know to read what encode() gives next: for the one who was there from
  /// the start as for the one who joins now.
  [[nodiscard]] std::vector<std::uint8_t> keyframe() const;

  /// Of the newest frame.
  [[nodiscard]] std::uint64_t sequence() const { return state_.sequence; }
  [[nodiscard]] std::uint64_t media_time() const { return state_.media_time; }
  [[nodiscard]] const FaceFrame& state() const { return state_.before[0]; }

 private:
  PackedState state_;
  const PackedTable* table_;
};

/// Whether a message is one of the packed form, by its first byte.
constexpr bool is_packed_keyframe(std::uint8_t type) { return type == packed_keyframe_type; }
constexpr bool is_packed_frames(std::uint8_t type) { return type >= packed_frames_type; }

/// Reads a whole message of the packed form, type and all; takes any bytes. Time and memory are bounded by the number
/// of frames, at most 1024. Errors say what is wrong, by the pointer that the plain form would have; `state` is then as
/// it was. `mismatch` at "/sequence": the frames do not follow `state`.
Result<Keyframe> read_packed_keyframe(std::span<const std::uint8_t> bytes, PackedState& state,
                                      const PackedTable& table = packed_tables::values);
Result<Frames> read_packed_frames(std::span<const std::uint8_t> bytes, PackedState& state,
                                  const PackedTable& table = packed_tables::values);

}  // namespace semblante

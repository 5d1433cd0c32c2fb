#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/types/result.h"
#include "protocol/cpp/byte_io.h"
#include "protocol/cpp/face_frame.h"

/// The binary form of a face state as the differences to another state: SPEC.md, "State".
namespace semblante {

inline constexpr std::uint8_t max_viseme = 14;
inline constexpr std::uint8_t max_expression = 6;
inline constexpr std::uint8_t max_blend = 63;

void append_state(std::vector<std::uint8_t>& to, const FaceFrame& from, const FaceFrame& state);

/// Decodes the next state in place of `state`, the previous one. `where`: JSON pointer of the state, for errors.
Status read_state(byte_io::Reader& reader, FaceFrame& state, const std::string& where);

/// Whether every member is within its documented range.
bool is_valid(const FaceFrame& state);

}  // namespace semblante

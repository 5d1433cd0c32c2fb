#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/types/result.h"
#include "protocol/cpp/messages.h"

namespace semblante {

/// First byte of a `text` in its packed form: SPEC.md, "Packed text".
inline constexpr std::uint8_t packed_text_type = 13;

/// Appends the packed form of a text; asserts that check_text accepts it.
void write_packed_text(const SpeechText& text, std::vector<std::uint8_t>& to);

/// Reads a message of the type packed_text_type from untrusted bytes. Needs 1.6 MB, half of which stay for the next
/// one, and at most 6,000 symbols' time. Errors: `truncated`, `malformed`, `too_large`, `out_of_range` with the pointer
/// of the value.
Result<SpeechText> read_packed_text(std::span<const std::uint8_t> bytes);

}  // namespace semblante

#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace semblante {

/// Where a sentence is divided into captions: one past the last word of each. As few as hold it (two lines of 37
/// letters, as subtitles have, a letter of Chinese, Japanese or Korean as wide as two), of about the same length, and
/// at the end of a clause where that needs no more. A word that is longer is not divided.
/// `begins`: the byte of `text` at which each word is written from, ascending; the sentence ends before `end`.
/// Pages divide alike (`clients/js/captions/cues.ts`), but divide such words too; `tests/golden/speech/cues.json` tests
/// both.
std::vector<std::size_t> cue_ends(std::string_view text, std::span<const std::size_t> begins, std::size_t end);

}  // namespace semblante

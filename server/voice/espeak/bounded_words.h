#pragma once

#include <string>
#include <string_view>

namespace semblante::voice {

/// The text with as many characters, without what overflows fixed buffers of libespeak-ng: of an abbreviation of more
/// than `most_signs` letters ("a.b.c.d...", also with spaces between them) every further such dot is a comma, and of
/// the apostrophes in a word ("s's's...") a space. Tags of SSML stay as they are.
std::string with_bounded_words(std::string_view text, bool ssml);
inline constexpr int most_signs = 16;

}  // namespace semblante::voice

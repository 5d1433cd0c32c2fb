#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

#include "core/speech/utterance.h"
#include "core/types/printable.h"

namespace semblante {

/// Number of bytes of the first character of a text of XML, which is not empty: a reference ("&amp;", "&#46;") is one.
inline std::size_t xml_character_bytes(std::string_view text) {
  constexpr std::size_t longest_reference = 12;
  const std::size_t end = text[0] == '&' ? text.substr(0, longest_reference).find(';') : std::string_view::npos;
  return end != std::string_view::npos ? end + 1 : utf8_step(text);
}

/// A text by its characters (code points).
class Characters {
 public:
  /// The text must outlive this object.
  explicit Characters(std::string_view text) : text_(text) {
    for (std::size_t at = 0; at < text.size(); at += utf8_step(text.substr(at))) offsets_.push_back(at);
    offsets_.push_back(text.size());
  }

  [[nodiscard]] std::size_t count() const { return offsets_.size() - 1; }
  /// The byte at which a character begins; the end of the text for any beyond it.
  [[nodiscard]] std::size_t byte_of(std::size_t character) const {
    return offsets_[std::min(character, offsets_.size() - 1)];
  }
  [[nodiscard]] std::string_view of(const TextRange& range) const {
    const std::size_t begin = byte_of(range.first);
    return text_.substr(begin, byte_of(range.first + range.count) - begin);
  }

 private:
  std::string_view text_;
  std::vector<std::size_t> offsets_;
};

}  // namespace semblante

#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/types/result.h"

namespace semblante {

/// A tag of an element; its parts point into the text that was read.
struct XmlTag {
  std::string_view name;
  bool closes = false;    ///< </name>
  bool is_empty = false;  ///< <name/>
  std::vector<std::pair<std::string_view, std::string_view>> attributes;
  std::size_t bytes = 0;

  [[nodiscard]] std::optional<std::string_view> attribute(std::string_view wanted) const;
};

/// Reads the tag at the beginning of a text, which is '<'. At most 16 attributes, between quotes, none twice.
Result<XmlTag> read_xml_tag(std::string_view text);

/// An expression with its intensity, as tags name it: <emotion name="joy" intensity="0.5">, <prosody emotion="joy">.
struct NamedEmotion {
  std::uint8_t expression = 0;
  double intensity = 1.0;
};
/// Reads it from the attributes `name_attribute` and `intensity`.
Result<NamedEmotion> emotion_of(const XmlTag& tag, std::string_view name_attribute);
/// 0 to 1, of decimal text.
std::optional<double> read_intensity(std::string_view text);

}  // namespace semblante

#include "core/speech/xml_tag.h"

#include <algorithm>
#include <string>

#include "core/speech/marked_text.h"
#include "core/types/decimal.h"
#include "core/types/printable.h"

namespace semblante {
namespace {

constexpr std::size_t most_attributes = 16;
constexpr std::string_view blanks = " \t\n";

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == ':';
}

std::string_view take_name(std::string_view& rest) {
  const auto* const end = std::find_if_not(rest.begin(), rest.end(), is_name_character);
  const auto name = rest.substr(0, static_cast<std::size_t>(end - rest.begin()));
  rest.remove_prefix(name.size());
  return name;
}

void skip_blanks(std::string_view& rest) { rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size())); }

Error malformed(std::string message) { return {ErrorCode::malformed, "text", std::move(message)}; }

}  // namespace

std::optional<std::string_view> XmlTag::attribute(std::string_view wanted) const {
  const auto at =
      std::find_if(attributes.begin(), attributes.end(), [&](const auto& one) { return one.first == wanted; });
  return at == attributes.end() ? std::nullopt : std::optional(at->second);
}

Result<XmlTag> read_xml_tag(std::string_view text) {
  std::string_view rest = text.substr(1);
  XmlTag tag;
  tag.closes = rest.starts_with('/');
  if (tag.closes) rest.remove_prefix(1);
  tag.name = take_name(rest);
  if (tag.name.empty()) return malformed("a tag has no name");
  for (;;) {
    skip_blanks(rest);
    if (rest.starts_with('>')) break;
    if (rest.starts_with("/>") && !tag.closes) {
      tag.is_empty = true;
      rest.remove_prefix(1);
      break;
    }
    const std::string_view name = take_name(rest);
    skip_blanks(rest);
    const std::string what = "the tag <" + printable(tag.name) + ">";
    if (rest.empty()) return malformed(what + " has no end");
    if (name.empty() || tag.closes || !rest.starts_with('='))
      return malformed(what + " must have name=\"value\" alone");
    rest.remove_prefix(1);
    skip_blanks(rest);
    const std::string_view quote = rest.substr(0, 1);
    if (quote != "\"" && quote != "'") return malformed(what + " must have its values between quotes");
    const std::size_t end = rest.find(quote, 1);
    if (end == std::string_view::npos) return malformed(what + " has no end");
    if (tag.attribute(name) || tag.attributes.size() == most_attributes)
      return malformed(what + " has an attribute twice, or too many");
    tag.attributes.emplace_back(name, rest.substr(1, end - 1));
    rest.remove_prefix(end + 1);
  }
  tag.bytes = text.size() - rest.size() + 1;
  return tag;
}

std::optional<double> read_intensity(std::string_view text) {
  const auto value = read_double(text);
  return value && *value >= 0.0 && *value <= 1.0 ? value : std::nullopt;
}

Result<NamedEmotion> emotion_of(const XmlTag& tag, std::string_view name_attribute) {
  const std::string what = "<" + std::string(tag.name) + ">";
  const int expression = expression_of(tag.attribute(name_attribute).value_or(""));
  if (expression < 1) {
    std::string names;
    for (int i = 1; const std::string& name : emotion_names())
      if (i++ > 1) names.append(names.empty() ? "" : ", ").append(name);
    return malformed("the " + std::string(name_attribute) + " of " + what + " must be one of " + names);
  }
  const auto intensity = read_intensity(tag.attribute("intensity").value_or("1"));
  if (!intensity) return malformed("the intensity of " + what + " must be 0 to 1");
  return NamedEmotion{static_cast<std::uint8_t>(expression), *intensity};
}

}  // namespace semblante

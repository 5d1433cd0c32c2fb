#include "protocol/codegen/render.h"
#include "protocol/codegen/schema.h"

namespace semblante::codegen {
namespace {

std::string escaped(const std::string& hexadecimal) {
  std::string out;
  for (std::size_t i = 0; i + 1 < hexadecimal.size(); i += 2) out += "\\x" + hexadecimal.substr(i, 2);
  return out;
}

}  // namespace

std::string render_text_prime(const Json& prime) {
  std::string out = R"(// Generated from protocol/schema by semblante-codegen-protocol; change the schema, not this.
// clang-format off
#pragma once

#include <array>
#include <string_view>

namespace semblante {

/// A text that both sides of a packed text know: SPEC.md, "Packed text".
struct KnownText {
  std::string_view language, text, score;
};

)";
  const Json& texts = prime.at("texts");
  out += "inline constexpr std::array<KnownText, " + std::to_string(texts.size()) + "> text_prime = {{\n";
  for (const Json& known : texts) {
    const std::string score = text(known, "score");
    out += "    {" + known.at("language").dump() + ", " + known.at("text").dump() + ", {\"" + escaped(score) + "\", " +
           std::to_string(score.size() / 2) + "}},\n";
  }
  return out + "}};\n\n}  // namespace semblante\n";
}

}  // namespace semblante::codegen

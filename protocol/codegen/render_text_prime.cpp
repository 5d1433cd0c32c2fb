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
#include <cstdint>

namespace semblante {

/// Sizes in bytes of a text that both sides of a packed text know: SPEC.md, "Packed text".
struct KnownText {
  std::uint16_t language, text, score;
};

)";
  std::string sizes, bytes;
  for (const Json& known : prime.at("texts")) {
    const std::string language = text(known, "language"), words = text(known, "text"), score = text(known, "score");
    sizes += "    {" + std::to_string(language.size()) + ", " + std::to_string(words.size()) + ", " +
             std::to_string(score.size() / 2) + "},\n";
    bytes += "\n    " + known.at("language").dump() + " " + known.at("text").dump() + " \"" + escaped(score) + "\"";
  }
  out += "inline constexpr std::array<KnownText, " + std::to_string(prime.at("texts").size()) + "> text_prime = {{\n" +
         sizes +
         "}};\n\n/// Language, text and score of each, one after another: pointers to each would take more than they "
         "do.\n" +
         "inline constexpr char text_prime_bytes[] =" + bytes + ";\n";
  return out + "\n}  // namespace semblante\n";
}

}  // namespace semblante::codegen

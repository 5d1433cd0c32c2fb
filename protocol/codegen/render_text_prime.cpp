#include <memory>

#include "protocol/codegen/render.h"
#include "protocol/codegen/schema.h"
#include "protocol/cpp/range_coder.h"
#include "protocol/cpp/text_model.h"

namespace semblante::codegen {
namespace {

std::vector<std::uint8_t> bytes_of(const std::string& hexadecimal) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i + 1 < hexadecimal.size(); i += 2)
    bytes.push_back(static_cast<std::uint8_t>(std::stoul(hexadecimal.substr(i, 2), nullptr, 16)));
  return bytes;
}

/// The texts as a model codes them that has learned nothing else.
std::vector<std::uint8_t> packed(const Json& texts) {
  std::vector<std::uint8_t> bytes;
  RangeEncoder coder(bytes);
  const auto memory = std::make_unique<text_model::Memory>();
  text_model::TextModel model(coder, *memory);
  for (const Json& each : texts) {
    SpeechText known;
    known.language = text(each, "language");
    known.text = text(each, "text");
    known.score = bytes_of(text(each, "score"));
    model.message(known);
  }
  coder.finish();
  return bytes;
}

}  // namespace

std::string render_text_prime(const Json& prime) {
  const Json& texts = prime.at("texts");
  return R"(// Generated from protocol/schema by semblante-codegen-protocol; change the schema, not this.
// clang-format off
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace semblante {

/// The texts that encoder and decoder know in advance (SPEC.md, "Packed text"), compressed by the model of packed texts
/// itself: decoding them trains it.
inline constexpr std::size_t text_prime_count = )" +
         std::to_string(texts.size()) + ";\ninline constexpr auto text_prime = std::to_array<std::uint8_t>({\n" +
         numbers(Json(packed(texts)), "    ") + "});\n\n}  // namespace semblante\n";
}

}  // namespace semblante::codegen

#pragma once

#include <span>
#include <string_view>

namespace semblante {

/// A symbol of another system's visemes, and a sound that looks so, in IPA: one that the table of English has, in two
/// parts where the mouth moves. Empty: the mouth is at rest.
struct VisemeSymbol {
  std::string_view symbol;
  std::string_view ipa;
};

struct VisemeSymbols {
  std::string_view system;
  std::string_view source;  ///< the public document that describes the symbols
  std::span<const VisemeSymbol> rows;

  /// Null: the system has no such symbol.
  [[nodiscard]] const VisemeSymbol* find(std::string_view symbol) const;
};

namespace visemes {
extern constinit const VisemeSymbols azure;    ///< azure.cpp
extern constinit const VisemeSymbols polly;    ///< polly.cpp
extern constinit const VisemeSymbols rhubarb;  ///< rhubarb.cpp
extern constinit const VisemeSymbols oculus;   ///< oculus_visemes.cpp
}  // namespace visemes

}  // namespace semblante

#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/access/scope.h"
#include "server/store/records.h"

namespace semblante::access {

/// What a new token shall allow.
struct TokenWish {
  std::string name;  ///< for people
  Scope scope = Scope::read;
  std::string stream, model;         ///< of these only; at most one of them
  std::optional<std::int64_t> life;  ///< seconds; empty: it does not expire
};

/// A token that no store has yet, and the text that its owner sends. The text is nowhere else.
struct NewToken {
  store::TokenRecord record;
  std::string text;
};
NewToken make_token(const TokenWish& wish);

}  // namespace semblante::access

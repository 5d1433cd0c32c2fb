#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "server/store/records.h"

namespace semblante::store {

/// Tokens. The rules of Store (store.h) hold.
class TokenStore {
 public:
  virtual ~TokenStore() = default;

  virtual void add_token(const TokenRecord& token) = 0;
  /// By creation, the oldest first; expired ones too.
  virtual std::vector<TokenRecord> tokens() = 0;
  /// False when there is no such token.
  virtual bool remove_token(std::string_view id) = 0;
  /// A number that changes when another program has changed the database. Cheap: reads no table.
  virtual std::int64_t changes_by_others() = 0;
};

}  // namespace semblante::store

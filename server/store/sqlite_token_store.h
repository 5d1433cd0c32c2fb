#pragma once

// Private to store/.

#include <string_view>
#include <vector>

#include "server/store/sqlite_part.h"
#include "server/store/token_store.h"

namespace semblante::store {

class SqliteTokenStore : public virtual TokenStore, private SqlitePart {
 public:
  using SqlitePart::SqlitePart;

  void add_token(const TokenRecord& token) override;
  std::vector<TokenRecord> tokens() override;
  bool remove_token(std::string_view id) override;
  std::int64_t changes_by_others() override;
};

}  // namespace semblante::store

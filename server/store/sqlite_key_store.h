#pragma once

// Private to store/.

#include <optional>
#include <string_view>

#include "server/store/key_store.h"
#include "server/store/sqlite_part.h"

namespace semblante::store {

class SqliteKeyStore : public virtual KeyStore, private SqlitePart {
 public:
  using SqlitePart::SqlitePart;

  std::optional<IdempotencyRecord> idempotency(std::string_view key) override;
};

}  // namespace semblante::store

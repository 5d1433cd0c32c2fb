#pragma once

#include <optional>
#include <string_view>

#include "server/store/records.h"

namespace semblante::store {

/// Idempotency keys: a key is stored with what its request created, by that call of another part. The rules of Store
/// (store.h) hold.
class KeyStore {
 public:
  virtual ~KeyStore() = default;

  virtual std::optional<IdempotencyRecord> idempotency(std::string_view key) = 0;
};

}  // namespace semblante::store

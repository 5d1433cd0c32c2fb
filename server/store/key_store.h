#pragma once

#include <optional>
#include <string_view>

#include "server/store/records.h"

namespace semblante::store {

/// Idempotency keys. A key is stored in the transaction of another part that creates what its request asks for. The
/// rules of Store (store.h) hold.
class KeyStore {
 public:
  virtual ~KeyStore() = default;

  virtual std::optional<IdempotencyRecord> idempotency(std::string_view key) = 0;
};

}  // namespace semblante::store

#pragma once

#include "server/store/records.h"

namespace semblante::store {

/// The database itself: its identity, and whether it works. The rules of Store (store.h) hold.
class DatabaseFacts {
 public:
  virtual ~DatabaseFacts() = default;

  virtual DatabaseIdentity identity() = 0;
  /// Increments the number of starts and returns the new identity.
  virtual DatabaseIdentity count_start() = 0;
  /// Makes a cheap query, for /readyz.
  virtual bool healthy() = 0;
  /// Makes a commit that changes nothing; throws like any other commit.
  virtual void check_writable() = 0;
};

}  // namespace semblante::store

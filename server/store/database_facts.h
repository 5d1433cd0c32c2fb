#pragma once

#include "server/store/records.h"

namespace semblante::store {

/// The database itself: which one it is, and whether it works. The rules of Store (store.h) hold.
class DatabaseFacts {
 public:
  virtual ~DatabaseFacts() = default;

  virtual DatabaseIdentity identity() = 0;
  /// One start more; the identity from now on.
  virtual DatabaseIdentity count_start() = 0;
  /// A cheap question to the disk, for /readyz.
  virtual bool healthy() = 0;
  /// A commit that changes nothing; throws as one that does.
  virtual void check_writable() = 0;
};

}  // namespace semblante::store

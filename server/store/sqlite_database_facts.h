#pragma once

// Private to store/.

#include "server/store/database_facts.h"
#include "server/store/sqlite_part.h"

namespace semblante::store {

class SqliteDatabaseFacts : public virtual DatabaseFacts, private SqlitePart {
 public:
  using SqlitePart::SqlitePart;

  DatabaseIdentity identity() override;
  DatabaseIdentity count_start() override;
  bool healthy() override;
  void check_writable() override;
};

}  // namespace semblante::store

#pragma once

// Private to store/.

#include <string_view>

#include "server/store/owner_store.h"
#include "server/store/sqlite_part.h"

namespace semblante::store {

class SqliteOwnerStore : public virtual OwnerStore, private SqlitePart {
 public:
  using SqlitePart::SqlitePart;

  Usage usage_of(std::string_view owner) override;
};

}  // namespace semblante::store

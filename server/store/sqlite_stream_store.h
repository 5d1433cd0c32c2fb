#pragma once

// Private to store/.

#include <optional>
#include <string_view>
#include <vector>

#include "server/store/sqlite_part.h"
#include "server/store/stream_store.h"

namespace semblante::store {

class SqliteStreamStore : public virtual StreamStore, private SqlitePart {
 public:
  using SqlitePart::SqlitePart;

  bool create_stream(const StreamRecord& stream, const std::optional<IdempotencyRecord>& key) override;
  std::vector<StreamRecord> streams() override;
  bool remove_stream(std::string_view id) override;
};

}  // namespace semblante::store

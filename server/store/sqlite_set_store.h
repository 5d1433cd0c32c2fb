#pragma once

// Private to store/.

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "server/store/set_store.h"
#include "server/store/sqlite_part.h"

namespace semblante::store {

class SqliteSetStore : public virtual SetStore, private SqlitePart {
 public:
  using SqlitePart::SqlitePart;

  void create_set(const SetRecord& set, const std::optional<IdempotencyRecord>& key) override;
  std::optional<SetRecord> set(std::string_view id) override;
  std::optional<std::vector<SetRecord>> sets(std::string_view after, std::size_t limit) override;
  std::size_t set_count() override;
  bool put_set(const SetRecord& set) override;
  bool remove_set(std::string_view id) override;
};

}  // namespace semblante::store

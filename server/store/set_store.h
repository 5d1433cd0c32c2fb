#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "server/store/records.h"

namespace semblante::store {

/// Displacement sets that clients made. The rules of Store (store.h) hold.
class SetStore {
 public:
  virtual ~SetStore() = default;

  virtual void create_set(const SetRecord& set, const std::optional<IdempotencyRecord>& key) = 0;
  virtual std::optional<SetRecord> set(std::string_view id) = 0;
  /// Like models().
  virtual std::optional<std::vector<SetRecord>> sets(std::string_view after, std::size_t limit) = 0;
  virtual std::size_t set_count() = 0;
  /// Replaces name, kind and displacements. False when the set does not exist or its revision is not `set.revision`.
  virtual bool put_set(const SetRecord& set) = 0;
  /// False when it does not exist. Models that use the set keep their copy.
  virtual bool remove_set(std::string_view id) = 0;
};

}  // namespace semblante::store

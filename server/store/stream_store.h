#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "server/store/records.h"

namespace semblante::store {

/// Streams with their settings. The rules of Store (store.h) hold.
class StreamStore {
 public:
  virtual ~StreamStore() = default;

  /// False when the id is taken.
  virtual bool create_stream(const StreamRecord& stream, const std::optional<IdempotencyRecord>& key) = 0;
  virtual std::vector<StreamRecord> streams() = 0;
  virtual bool remove_stream(std::string_view id) = 0;
};

}  // namespace semblante::store

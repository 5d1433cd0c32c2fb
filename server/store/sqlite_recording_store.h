#pragma once

// Private to store/.

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "server/store/recording_store.h"
#include "server/store/sqlite_part.h"

namespace semblante::store {

class SqliteRecordingStore : public virtual RecordingStore, private SqlitePart {
 public:
  using SqlitePart::SqlitePart;

  void create_recording(const RecordingRecord& recording, const std::optional<IdempotencyRecord>& key) override;
  std::optional<RecordingRecord> recording(std::string_view id) override;
  std::optional<RecordingRecord> newest_recording(std::string_view stream) override;
  std::optional<std::vector<RecordingRecord>> recordings(std::string_view stream, std::string_view after,
                                                         std::size_t limit) override;
  std::size_t recording_count() override;
  void finish_recording(const RecordingRecord& recording) override;
  bool remove_recording(std::string_view id) override;
};

}  // namespace semblante::store

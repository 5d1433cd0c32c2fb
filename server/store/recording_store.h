#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "server/store/records.h"

namespace semblante::store {

/// Facts about recordings; their frames are files (server/recordings). The rules of Store (store.h) hold.
class RecordingStore {
 public:
  virtual ~RecordingStore() = default;

  virtual void create_recording(const RecordingRecord& recording, const std::optional<IdempotencyRecord>& key) = 0;
  virtual std::optional<RecordingRecord> recording(std::string_view id) = 0;
  virtual std::optional<RecordingRecord> newest_recording(std::string_view stream) = 0;
  /// Like models(); of one stream, or of all if `stream` is empty.
  virtual std::optional<std::vector<RecordingRecord>> recordings(std::string_view stream, std::string_view after,
                                                                 std::size_t limit) = 0;
  virtual std::size_t recording_count() = 0;
  /// Stores the end of a recording: state, reason, duration and size. Does nothing when the recording does not exist.
  virtual void finish_recording(const RecordingRecord& recording) = 0;
  virtual bool remove_recording(std::string_view id) = 0;
};

}  // namespace semblante::store

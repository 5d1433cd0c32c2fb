#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/store/records.h"

namespace semblante::store {

/// Speeches; their files are blobs. The rules of Store (store.h) hold.
class SpeechStore {
 public:
  virtual ~SpeechStore() = default;

  virtual void create_speech(const SpeechRecord& speech, const std::optional<IdempotencyRecord>& key) = 0;
  virtual std::optional<SpeechRecord> speech(std::string_view id) = 0;
  /// Like models().
  virtual std::optional<std::vector<SpeechRecord>> speeches(std::string_view after, std::size_t limit) = 0;
  virtual std::size_t speech_count() = 0;
  /// The blobs that no record refers to any more; nullopt when there is no such speech.
  virtual std::optional<std::vector<std::string>> remove_speech(std::string_view id) = 0;
};

}  // namespace semblante::store

#pragma once

// Private to store/.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/store/speech_store.h"
#include "server/store/sqlite_part.h"

namespace semblante::store {

class SqliteSpeechStore : public virtual SpeechStore, private SqlitePart {
 public:
  using SqlitePart::SqlitePart;

  void create_speech(const SpeechRecord& speech, const std::optional<IdempotencyRecord>& key) override;
  std::optional<SpeechRecord> speech(std::string_view id) override;
  std::optional<std::vector<SpeechRecord>> speeches(std::string_view after, std::size_t limit) override;
  std::size_t speech_count() override;
  std::optional<std::vector<std::string>> remove_speech(std::string_view id) override;
};

}  // namespace semblante::store

#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "server/voice/voice_protocol.h"

namespace semblante::api {

/// The voices that the voice program listed last, so that the list is answered also while the program speaks. Any
/// thread.
class KnownVoices {
 public:
  using Clock = std::chrono::steady_clock;
  /// After this the program is asked again: somebody may have installed a voice.
  static constexpr std::chrono::seconds max_age{60};

  /// The list, unless it is older than `max_age` at `now`.
  [[nodiscard]] std::optional<std::vector<voice::VoiceName>> at(Clock::time_point now) const {
    const std::lock_guard lock(mutex_);
    if (!names_ || now - told_at_ > max_age) return std::nullopt;
    return names_;
  }

  void keep(std::vector<voice::VoiceName> names, Clock::time_point now) {
    const std::lock_guard lock(mutex_);
    names_ = std::move(names);
    told_at_ = now;
  }

 private:
  mutable std::mutex mutex_;
  std::optional<std::vector<voice::VoiceName>> names_;
  Clock::time_point told_at_;
};

}  // namespace semblante::api

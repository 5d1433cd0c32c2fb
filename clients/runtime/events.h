#pragma once

#include <cstdint>
#include <memory>

#include "clients/runtime/ring.h"
#include "clients/runtime/semblante.h"
#include "core/types/result.h"
#include "protocol/cpp/messages.h"

namespace semblante::runtime {

/// What semblante_event says, in the little memory that most events need.
struct Event {
  semblante_event_type type = SEMBLANTE_EVENT_NONE;
  std::uint32_t state = 0, code = 0, resumed = 0;
  bool is_final = false;
  std::uint64_t epoch = 0, sequence = 0;
  double media_time = 0, round_trip = 0, server_offset = 0;
  std::unique_ptr<Error> error;
  std::unique_ptr<SoundPacket> sound;
  std::unique_ptr<SpeechText> text;
};

/// The events that the caller has not taken yet. Bounded: events that only inform give way to those that ask for
/// something.
class Events {
 public:
  static constexpr std::size_t most = 64;

  void push(Event event) {
    if (events_.size() == most) drop_one();
    events_.push_back(std::move(event));
  }
  [[nodiscard]] bool empty() const { return events_.empty(); }
  Event take() {
    Event event = std::move(events_.front());
    events_.pop_front();
    return event;
  }

 private:
  static bool only_informs(semblante_event_type type) {
    return type == SEMBLANTE_EVENT_KEYFRAME || type == SEMBLANTE_EVENT_FRAMES || type == SEMBLANTE_EVENT_CLOCK ||
           type == SEMBLANTE_EVENT_REFUSED || type == SEMBLANTE_EVENT_SOUND || type == SEMBLANTE_EVENT_TEXT;
  }
  void drop_one() {
    std::size_t oldest = 0;
    for (std::size_t i = 0; i < events_.size(); ++i) {
      if (only_informs(events_[i].type)) {
        oldest = i;
        break;
      }
    }
    events_.erase(oldest);
  }

  Ring<Event> events_;
};

}  // namespace semblante::runtime

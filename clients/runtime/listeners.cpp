#include <algorithm>
#include <memory>
#include <string>

#include "clients/runtime/border.h"
#include "core/listen/live_mouth.h"

struct semblante_listener {
  explicit semblante_listener(uint32_t sample_rate) : ear(sample_rate) {}
  semblante::VisemeListener ear;
  semblante::LiveMouth mouth;
};

namespace semblante::runtime {
static_assert(VisemeNetwork::visemes == SEMBLANTE_VISEME_COUNT);
static_assert(VisemeListener::delay_ms == SEMBLANTE_LISTENER_DELAY_MS);
}  // namespace semblante::runtime

using namespace semblante;
using namespace semblante::runtime;

extern "C" {

semblante_result semblante_listener_create(const semblante_listener_options* options, semblante_listener** listener,
                                           semblante_error* error) {
  if (listener == nullptr) return fail(error, SEMBLANTE_INVALID_ARGUMENT, "listener", "the pointer for it is null");
  *listener = nullptr;
  semblante_listener_options given;
  if (!read_struct(options, given)) return fail(error, SEMBLANTE_INVALID_ARGUMENT, "options.size", "is too small");
  if (given.sample_rate < VisemeListener::least_rate || given.sample_rate > VisemeListener::most_rate)
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "options.sample_rate", "must be 8000 to 192000");
  return guarded(error, [&] {
    *listener = std::make_unique<semblante_listener>(given.sample_rate).release();
    return SEMBLANTE_OK;
  });
}

void semblante_listener_destroy(semblante_listener* listener) { delete listener; }

semblante_result semblante_listener_push(semblante_listener* listener, const float* samples, uint32_t count,
                                         uint32_t* taken, semblante_heard* heard) {
  if (taken != nullptr) *taken = 0;
  if (listener == nullptr || taken == nullptr || heard == nullptr || (samples == nullptr && count > 0))
    return SEMBLANTE_INVALID_ARGUMENT;
  std::size_t used = 0;
  const auto found = listener->ear.push({samples, count}, used);
  *taken = static_cast<uint32_t>(used);
  if (!found) return SEMBLANTE_UNAVAILABLE;
  semblante_heard result{};
  result.level = found->level;
  result.time = found->time;
  const auto& weights = listener->mouth.follow(*found);
  std::copy(weights.begin(), weights.end(), result.weights);
  std::copy(found->probability.begin(), found->probability.end(), result.probability);
  return write_struct(result, heard) ? SEMBLANTE_OK : SEMBLANTE_INVALID_ARGUMENT;
}

}  // extern "C"

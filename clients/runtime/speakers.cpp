#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "clients/runtime/border.h"
#include "clients/runtime/speaker.h"
#include "clients/runtime/times.h"
#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/packed_text.h"

struct semblante_speaker {
  explicit semblante_speaker(std::uint32_t seed) : it(seed) {}
  semblante::runtime::Speaker it;
};

using namespace semblante;
using namespace semblante::runtime;

extern "C" {

semblante_result semblante_speaker_create(uint32_t seed, semblante_speaker** speaker, semblante_error* error) {
  if (speaker == nullptr) return fail(error, SEMBLANTE_INVALID_ARGUMENT, "speaker", "the pointer for it is null");
  *speaker = nullptr;
  return guarded(error, [&] {
    *speaker = std::make_unique<semblante_speaker>(seed).release();
    return SEMBLANTE_OK;
  });
}

void semblante_speaker_destroy(semblante_speaker* speaker) { delete speaker; }

semblante_result semblante_speaker_say(semblante_speaker* speaker, const uint8_t* score, size_t size,
                                       uint32_t first_word, double now) {
  if (speaker == nullptr || (score == nullptr && size != 0) || size > max_score_bytes || !is_time(now))
    return SEMBLANTE_INVALID_ARGUMENT;
  return guarded(nullptr, [&] {
    auto read = read_score({score, size});
    if (!read) return SEMBLANTE_INVALID_ARGUMENT;
    speaker->it.say(*std::move(read), first_word, now);
    return SEMBLANTE_OK;
  });
}

void semblante_speaker_reach(semblante_speaker* speaker, uint32_t word, double now) {
  if (speaker != nullptr && is_time(now)) guarded([&] { speaker->it.reach(word, now); });
}

void semblante_speaker_end(semblante_speaker* speaker, double now) {
  if (speaker != nullptr && is_time(now)) guarded([&] { speaker->it.end(now); });
}

uint32_t semblante_speaker_show(semblante_speaker* speaker, double now, semblante_frame* frame) {
  if (speaker == nullptr || frame == nullptr || !is_time(now) || !is_finite(*frame)) return 0;
  return speaker->it.show(now, *frame) ? 1 : 0;
}

semblante_result semblante_score_words(const uint8_t* score, uint32_t size, double* times, uint32_t* count) {
  if (count == nullptr || (score == nullptr && size != 0) || size > max_score_bytes) return SEMBLANTE_INVALID_ARGUMENT;
  return guarded(nullptr, [&] {
    const auto read = read_score({score, size});
    if (!read) return SEMBLANTE_INVALID_ARGUMENT;
    const std::uint32_t capacity = times == nullptr ? 0 : *count;
    *count = 0;
    for (const auto& step : read->steps) {
      if (!step.begins_word) continue;
      if (*count < capacity) times[*count] = step.begin;
      ++*count;
    }
    return times == nullptr || *count <= capacity ? SEMBLANTE_OK : SEMBLANTE_BUFFER_TOO_SMALL;
  });
}

size_t semblante_speaker_unpack(const uint8_t* packed, size_t size, uint8_t* plain, size_t capacity) {
  if (packed == nullptr || plain == nullptr || size == 0 || packed[0] != packed_text_type) return 0;
  size_t written = 0;
  guarded([&] {
    const auto text = read_packed_text({packed, size});
    if (!text) return;
    std::vector<std::uint8_t> bytes;
    encode_message(*text, bytes);
    if (bytes.size() > capacity) return;
    std::copy(bytes.begin(), bytes.end(), plain);
    written = bytes.size();
  });
  return written;
}

}  // extern "C"

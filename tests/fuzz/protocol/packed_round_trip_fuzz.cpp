// Frames made of the input, whatever they are, must come back from the packed form as they were, to readers who were
// there from the start and to those who joined in between.
#include <algorithm>
#include <cstdlib>

#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/packed_codec.h"

using namespace semblante;

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

/// Takes the input apart; zeros when it is used up.
class Source {
 public:
  Source(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  [[nodiscard]] bool empty() const { return at_ >= size_; }
  std::uint8_t byte() { return at_ < size_ ? data_[at_++] : std::uint8_t{0}; }
  std::uint64_t number(unsigned bytes) {
    std::uint64_t value = 0;
    while (bytes-- > 0) value = value << 8U | byte();
    return value;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

void change(FaceFrame& state, Source& source) {
  const std::uint8_t what = source.byte();
  if ((what & 1U) != 0) {
    state.viseme = {static_cast<std::uint8_t>(source.byte() % 15), static_cast<std::uint8_t>(source.byte() % 15),
                    static_cast<std::uint8_t>(source.byte() % 64)};
  }
  if ((what & 2U) != 0) {
    state.expression = {static_cast<std::uint8_t>(source.byte() % 7), static_cast<std::uint8_t>(source.byte() % 64),
                        static_cast<std::uint8_t>(source.byte() % 7), static_cast<std::uint8_t>(source.byte() % 64)};
  }
  for (unsigned i = what >> 4U; i > 0; --i) {
    auto& level = state.level[3 + source.byte() % 66];
    const bool far = (what & 4U) != 0;
    const int by = far ? static_cast<int>(source.number(2)) - 32768 : source.byte() - 128;
    level = static_cast<std::int16_t>(std::clamp(level + by, -32767, 32767));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Source source(data, size);
  Keyframe start;
  start.sequence = source.number(4);
  start.media_time = source.number(4);
  change(start.state, source);
  PackedEncoder encoder(start);
  FrameDecoder reader;
  FrameDecoder late;
  const auto first = reader.decode(encoder.keyframe());
  require(first && *first == Message(start));
  FaceFrame state = start.state;
  while (!source.empty()) {
    const std::uint8_t how = source.byte();
    Frames batch;
    batch.sequence = encoder.sequence() + 1;
    batch.media_time = (how & 1U) != 0 ? source.number(6) % (max_media_time + 1) : encoder.media_time() + 40;
    batch.media_time = std::min(batch.media_time, max_media_time);
    std::uint32_t time = (how & 2U) != 0 ? source.byte() : 0U;
    for (unsigned i = 0; i < 1U + (how >> 4U); ++i) {
      change(state, source);
      batch.frames.push_back({time, state});
      time += (how & 4U) != 0 ? static_cast<std::uint32_t>(source.number(2)) : 40U;
    }
    late.reset();
    require(late.decode(encoder.keyframe()).ok());
    const auto bytes = encoder.encode(batch);
    for (FrameDecoder* each : {&reader, &late}) {
      const auto message = each->decode(bytes);
      require(message && *message == Message(batch));
    }
  }
  return 0;
}

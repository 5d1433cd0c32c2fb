#include <array>
#include <cstring>
#include <limits>

#include "clients/runtime/semblante.h"
#include "tests/fuzz/runtime/pieces.h"

namespace {

/// A stream, a player that follows it, and what a caller does with them. Whatever a server says: events and frames are
/// within their documented ranges, and what waits to be sent or told is bounded.
struct Session {
  semblante_stream* stream = nullptr;
  semblante_player* player = nullptr;
  semblante_speaker* speaker = nullptr;
  double now = 1000;

  explicit Session(std::uint8_t flags) {
    semblante_stream_options options{};
    options.size = sizeof(options);
    options.role = flags & 1U;
    options.take_over = flags >> 1U & 1U;
    options.batch = (flags & 4U) != 0 ? 100 : 0;
    options.seed = 1;
    options.sound = flags >> 6U & 1U;
    options.text = flags >> 7U & 1U;
    must(semblante_stream_create(&options, &stream, nullptr) == SEMBLANTE_OK);
    semblante_player_options showing{};
    showing.size = sizeof(showing);
    showing.eased = flags >> 3U & 1U;
    showing.delay = (flags & 16U) != 0 ? 200 : 0;
    showing.max_frames = (flags & 32U) != 0 ? 16 : 0;
    must(semblante_player_create(&showing, &player, nullptr) == SEMBLANTE_OK);
    must(semblante_player_follow(player, stream) == SEMBLANTE_OK);
    must(semblante_speaker_create(1, &speaker, nullptr) == SEMBLANTE_OK);
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session() {
    semblante_stream_destroy(stream);
    semblante_player_destroy(player);
    semblante_speaker_destroy(speaker);
  }

  /// A voice that says each text, and tells words that the text may not have.
  void speak(const semblante_event& event) {
    must(semblante_speaker_say(speaker, event.packet, event.packet_size, event.packet_size % 3, now) == SEMBLANTE_OK);
    for (std::uint32_t word = 0; word < 4; ++word) {
      semblante_speaker_reach(speaker, word * word, now + 100.0 * word);
      semblante_frame frame{};
      semblante_speaker_show(speaker, now + 110.0 * word, &frame);
      must(frame.viseme1 <= 14 && frame.viseme2 <= 14 && frame.viseme_blend <= 63 && frame.expression1 <= 6 &&
           frame.intensity1 <= 63 && frame.expression2 <= 6 && frame.intensity2 <= 63);
      must_be_finite(frame.fap);
    }
    semblante_speaker_end(speaker, now + 500.0);
    semblante_stream_spoken(stream, event.packet_size % 5, event.sequence, event.packet_size, now);
  }

  void take_events() {
    semblante_event event{};
    event.size = sizeof(event);
    int count = 0;
    while (semblante_stream_next_event(stream, &event) != 0) {
      must(++count <= 64);
      must(event.type > SEMBLANTE_EVENT_NONE && event.type <= SEMBLANTE_EVENT_TEXT &&
           event.state <= SEMBLANTE_STREAM_WAITING);
      must(std::isfinite(event.media_time) && std::isfinite(event.round_trip) && std::isfinite(event.server_offset));
      const bool is_text = event.type == SEMBLANTE_EVENT_TEXT;
      must(event.type != SEMBLANTE_EVENT_SOUND || (event.packet != nullptr && event.duration <= 120));
      must(event.type == SEMBLANTE_EVENT_SOUND || is_text || event.packet == nullptr);
      must(is_text == (event.text != nullptr) && is_text == (event.language != nullptr));
      must(event.packet_size <= 4000 && event.duration >= 0 && event.duration <= 960'000);
      if (is_text) speak(event);
      for (std::uint32_t i = 0; i < event.packet_size; ++i) must(event.packet[i] <= 255);
      must(std::memchr(event.error.message, 0, sizeof(event.error.message)) != nullptr);
    }
    std::uint32_t frames = 0;
    const semblante_timed_frame* all = semblante_stream_frames(stream, &frames);
    for (std::uint32_t i = 0; i < frames; ++i) {
      must(std::isfinite(all[i].time) && all[i].frame.viseme1 <= 14 && all[i].frame.expression1 <= 6);
      must_be_finite(all[i].frame.fap);
    }
  }

  void take_bytes() {
    std::size_t size = 0;
    std::size_t sum = 0;
    while (const std::uint8_t* bytes = semblante_stream_take_bytes(stream, &size)) {
      must(size > 0 && bytes[size - 1] <= 255);
      sum += size;
    }
    must(sum <= (512U << 10U));
  }

  void look() const {
    semblante_header header{};
    header.size = sizeof(header);
    if (semblante_stream_header(stream, &header) == SEMBLANTE_OK) {
      must(header.stream != nullptr && header.quantizer != nullptr && std::isfinite(header.media_time));
      must_be_finite(std::span(header.quantizer, 69));
    }
    semblante_clock clock{};
    clock.size = sizeof(clock);
    if (semblante_stream_clock(stream, now, &clock) == SEMBLANTE_OK) must(std::isfinite(clock.media_time));
    must(!std::isnan(semblante_stream_wake_time(stream)));
    semblante_player_statistics statistics{};
    statistics.size = sizeof(statistics);
    must(semblante_player_stats(player, &statistics) == SEMBLANTE_OK && statistics.held <= 4096);
    semblante_timed_frame from{};
    semblante_timed_frame to{};
    float t = 0;
    if (semblante_player_between(player, &from, &to, &t) == SEMBLANTE_OK) {
      must(t >= 0 && t <= 1);
      must_be_finite(from.frame.fap);
      must_be_finite(to.frame.fap);
    }
  }

  void publish(std::uint8_t count, std::uint8_t value) {
    std::array<semblante_timed_frame, 8> frames{};
    const std::uint32_t used = count % frames.size() + 1U;
    for (std::uint32_t i = 0; i < used; ++i) {
      frames[i].time = i * (value & 63U);
      frames[i].frame.fap[3 + value % 66] = value == 255 ? std::numeric_limits<float>::quiet_NaN() : value * 10.0F;
    }
    static_cast<void>(semblante_stream_publish(stream, frames.data(), used, value == 1 ? 5 : 0, now));
  }
};

}  // namespace

/// The input: a byte of options, then steps. A step is a byte; messages have their length, of one byte or two, before
/// them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Pieces input(data, size);
  Session session(input.byte());
  semblante_stream_start(session.stream, session.now);
  semblante_stream_opened(session.stream, session.now);
  while (!input.is_empty()) {
    const std::uint8_t step = input.byte();
    switch (step) {
      case 'm':
      case 'M': {
        const auto message = input.bytes(step == 'm' ? input.byte() : input.word());
        // A copy of its own, so that a read beyond its end is seen.
        std::uint8_t* copy = static_cast<std::uint8_t*>(std::malloc(message.size() + 1));
        std::copy(message.begin(), message.end(), copy);
        static_cast<void>(semblante_stream_receive(session.stream, copy, message.size(), session.now));
        std::free(copy);
        break;
      }
      case 't':
        session.now += input.byte();
        semblante_stream_tick(session.stream, session.now);
        break;
      case 'T':
        session.now += 100.0 * input.byte();
        semblante_stream_tick(session.stream, session.now);
        break;
      case 'o':
        semblante_stream_opened(session.stream, session.now);
        break;
      case 'c':
        semblante_stream_closed(session.stream, input.word(), session.now);
        break;
      case 's':
        semblante_stream_stop(session.stream, session.now);
        break;
      case 'S':
        semblante_stream_start(session.stream, session.now);
        break;
      case 'a':
        session.now += 16;
        semblante_player_advance(session.player, session.now, 16);
        break;
      case 'v':
        semblante_player_move_to(session.player, 40.0 * input.byte());
        break;
      case 'x':
        semblante_player_clear(session.player);
        break;
      case 'p': {
        const std::uint8_t count = input.byte();
        session.publish(count, input.byte());
        break;
      }
      case 'q': {
        const double media_time = 20.0 * input.byte() - 20.0;
        const auto packet = input.bytes(input.byte());
        static_cast<void>(semblante_stream_publish_sound(session.stream, packet.data(),
                                                         static_cast<std::uint32_t>(packet.size()), media_time));
        break;
      }
      case 'k':
        semblante_stream_measure_clock(session.stream, session.now);
        break;
      default:
        session.take_bytes();
        break;
    }
    session.take_events();
    session.look();
  }
  session.take_bytes();
  return 0;
}

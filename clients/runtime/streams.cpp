#include <memory>
#include <string>
#include <utility>

#include "clients/runtime/border.h"
#include "clients/runtime/handles.h"
#include "clients/runtime/times.h"
#include "protocol/cpp/opus_packet.h"
#include "protocol/cpp/speech_score.h"

namespace semblante::runtime {
namespace {

/// 0: `usual`; negative: `none`.
double or_usual(double value, double usual, double none) { return value == 0 ? usual : value < 0 ? none : value; }

bool are_valid(const semblante_stream_options& options) {
  return options.role <= SEMBLANTE_ROLE_PUBLISH && is_time(options.retry_first) && options.retry_first >= 0 &&
         is_time(options.retry_longest) && options.retry_longest >= 0 && is_time(options.ping_interval) &&
         is_time(options.silence_limit) && is_time(options.batch) && options.batch >= 0 &&
         options.resume_epoch <= max_media_time && options.resume_sequence <= max_media_time;
}

StreamOptions to_options(const semblante_stream_options& from) {
  StreamOptions options;
  options.role = from.role == SEMBLANTE_ROLE_PUBLISH ? StreamRole::publish : StreamRole::subscribe;
  options.take_over = from.take_over != 0;
  if (from.max_message_bytes != 0 && from.max_message_bytes < options.max_message_bytes) {
    options.max_message_bytes = from.max_message_bytes;
  }
  options.retry_first = or_usual(from.retry_first, options.retry_first, 0);
  options.retry_longest = or_usual(from.retry_longest, options.retry_longest, 0);
  options.seed = from.seed;
  options.ping_interval = or_usual(from.ping_interval, options.ping_interval, 0);
  options.silence_limit = or_usual(from.silence_limit, options.silence_limit, never);
  options.batch = from.batch;
  options.sound = from.sound != 0;
  options.text = from.text != 0;
  options.captions = from.captions != 0;
  if (from.resume_epoch != 0) options.resume = ResumePoint{from.resume_epoch, from.resume_sequence};
  return options;
}

semblante_result to_result(Stream::Published published) {
  switch (published) {
    case Stream::Published::sent:
      return SEMBLANTE_OK;
    case Stream::Published::unavailable:
      return SEMBLANTE_UNAVAILABLE;
    default:
      return SEMBLANTE_INVALID_ARGUMENT;
  }
}

semblante_event to_event(const Event& from) {
  semblante_event event{};
  event.type = from.type;
  event.state = from.state;
  event.code = from.code;
  event.resumed = from.resumed;
  event.is_final = from.is_final ? 1 : 0;
  event.epoch = from.epoch;
  event.sequence = from.sequence;
  event.media_time = from.media_time;
  event.round_trip = from.round_trip;
  event.server_offset = from.server_offset;
  if (from.error) {
    copy_text(event.error.where, from.error->where);
    copy_text(event.error.message, from.error->message);
  }
  if (from.sound) {
    event.duration = opus_packet_ms(from.sound->packet).value_or(0);
    event.packet = from.sound->packet.data();
    event.packet_size = static_cast<uint32_t>(from.sound->packet.size());
  }
  if (from.text) {
    const auto score = read_score(from.text->score);
    event.duration = score ? score->duration() : 0;
    event.packet = from.text->score.data();
    event.packet_size = static_cast<uint32_t>(from.text->score.size());
    event.text = from.text->text.c_str();
    event.language = from.text->language.c_str();
  }
  return event;
}

}  // namespace
}  // namespace semblante::runtime

using namespace semblante;
using namespace semblante::runtime;

extern "C" {

semblante_result semblante_stream_create(const semblante_stream_options* options, semblante_stream** stream,
                                         semblante_error* error) {
  if (stream == nullptr) return fail(error, SEMBLANTE_INVALID_ARGUMENT, "stream", "the pointer for it is null");
  *stream = nullptr;
  semblante_stream_options chosen;
  if (!read_struct(options, chosen)) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "options", "its size is not set");
  }
  if (!are_valid(chosen)) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "options", "an unknown role, or a number outside its range");
  }
  return guarded(error, [&] {
    *stream = std::make_unique<semblante_stream>(to_options(chosen)).release();
    return SEMBLANTE_OK;
  });
}

void semblante_stream_destroy(semblante_stream* stream) { delete stream; }

void semblante_stream_start(semblante_stream* stream, double now) {
  if (stream != nullptr && is_time(now)) guarded([&] { stream->it.start(now); });
}

void semblante_stream_stop(semblante_stream* stream, double now) {
  if (stream != nullptr && is_time(now)) guarded([&] { stream->it.stop(); });
}

void semblante_stream_opened(semblante_stream* stream, double now) {
  if (stream != nullptr && is_time(now)) guarded([&] { stream->it.opened(now); });
}

semblante_result semblante_stream_receive(semblante_stream* stream, const uint8_t* bytes, size_t size, double now) {
  if (stream == nullptr || (bytes == nullptr && size != 0) || !is_time(now)) return SEMBLANTE_INVALID_ARGUMENT;
  return guarded(nullptr, [&] {
    stream->it.receive({bytes, size}, now);
    return SEMBLANTE_OK;
  });
}

void semblante_stream_closed(semblante_stream* stream, uint32_t /*code*/, double now) {
  if (stream != nullptr && is_time(now)) guarded([&] { stream->it.closed(now); });
}

void semblante_stream_tick(semblante_stream* stream, double now) {
  if (stream != nullptr && is_time(now)) guarded([&] { stream->it.tick(now); });
}

double semblante_stream_wake_time(const semblante_stream* stream) {
  return stream == nullptr ? never : stream->it.wake_time();
}

const uint8_t* semblante_stream_take_bytes(semblante_stream* stream, size_t* size) {
  if (size != nullptr) *size = 0;
  if (stream == nullptr || size == nullptr) return nullptr;
  const auto bytes = stream->it.outbox().take();
  *size = bytes.size();
  return bytes.empty() ? nullptr : bytes.data();
}

uint32_t semblante_stream_next_event(semblante_stream* stream, semblante_event* event) {
  if (stream == nullptr || event == nullptr || event->size < sizeof(event->size) || stream->it.events().empty())
    return 0;
  stream->told = stream->it.events().take();
  return write_struct(to_event(stream->told), event) ? 1 : 0;
}

const semblante_timed_frame* semblante_stream_frames(semblante_stream* stream, uint32_t* count) {
  if (count != nullptr) *count = 0;
  if (stream == nullptr || count == nullptr) return nullptr;
  const semblante_timed_frame* frames = nullptr;
  guarded([&] {
    const auto converted = stream->it.frames();
    *count = static_cast<uint32_t>(converted.size());
    if (!converted.empty()) frames = converted.data();
  });
  return frames;
}

semblante_stream_state semblante_stream_get_state(const semblante_stream* stream) {
  return stream == nullptr ? SEMBLANTE_STREAM_CLOSED : stream->it.state();
}

semblante_result semblante_stream_header(const semblante_stream* stream, semblante_header* header) {
  if (stream == nullptr) return SEMBLANTE_INVALID_ARGUMENT;
  semblante_header made{};
  const auto& from = stream->it.header();
  if (!from) return SEMBLANTE_UNAVAILABLE;
  made.resumed = stream->it.resumed();
  made.epoch = from->epoch;
  made.sequence = from->sequence;
  made.media_time = static_cast<double>(from->media_time);
  made.server_time = from->server_time;
  made.frame_rate = from->fps_hint;
  made.batch_interval = from->batch_interval;
  made.viseme_share = from->viseme_share.value_or(unknown_time);
  made.stream = from->stream.c_str();
  made.title = from->title.c_str();
  made.model = from->model.c_str();
  made.quantizer = stream->it.steps().data();
  if (from->sound) {
    made.sound_codec = static_cast<uint32_t>(from->sound->codec);
    made.sound_rate = from->sound->rate;
    made.sound_channels = from->sound->channels;
    made.sound_bitrate = from->sound->bitrate;
  }
  return write_struct(made, header) ? SEMBLANTE_OK : SEMBLANTE_INVALID_ARGUMENT;
}

semblante_result semblante_stream_clock(const semblante_stream* stream, double now, semblante_clock* clock) {
  if (stream == nullptr || !is_time(now)) return SEMBLANTE_INVALID_ARGUMENT;
  const auto& from = stream->it.clock();
  const auto media_time = from.at(now);
  if (!media_time) return SEMBLANTE_UNAVAILABLE;
  semblante_clock made{};
  made.steps = static_cast<uint32_t>(from.steps());
  made.media_time = *media_time;
  made.uncertainty = from.uncertainty().value_or(unknown_time);
  made.drift = from.drift();
  made.round_trip = from.round_trip().value_or(unknown_time);
  made.server_offset = stream->it.server_offset().value_or(unknown_time);
  return write_struct(made, clock) ? SEMBLANTE_OK : SEMBLANTE_INVALID_ARGUMENT;
}

void semblante_stream_measure_clock(semblante_stream* stream, double now) {
  if (stream != nullptr && is_time(now)) guarded([&] { stream->it.measure_clock(now); });
}

void semblante_stream_resume_point(const semblante_stream* stream, uint64_t* epoch, uint64_t* sequence) {
  ResumePoint point;
  if (stream != nullptr && stream->it.resume()) point = *stream->it.resume();
  if (epoch != nullptr) *epoch = point.epoch;
  if (sequence != nullptr) *sequence = point.sequence;
}

semblante_result semblante_stream_spoken(semblante_stream* stream, uint32_t state, uint64_t speech, uint32_t character,
                                         double now) {
  if (stream == nullptr || state > SEMBLANTE_VOICE_READY || speech > max_media_time ||
      character > max_speech_text_bytes || !is_time(now)) {
    return SEMBLANTE_INVALID_ARGUMENT;
  }
  return guarded(nullptr, [&] {
    return to_result(stream->it.spoken({static_cast<VoiceState>(state), speech, character, 0}, now));
  });
}

semblante_result semblante_stream_set_captions(semblante_stream* stream, uint32_t on) {
  if (stream == nullptr) return SEMBLANTE_INVALID_ARGUMENT;
  return guarded(nullptr, [&] { return stream->it.set_captions(on != 0) ? SEMBLANTE_OK : SEMBLANTE_INVALID_ARGUMENT; });
}

semblante_result semblante_stream_publish(semblante_stream* stream, const semblante_timed_frame* frames, uint32_t count,
                                          double media_time, double now) {
  if (stream == nullptr || frames == nullptr || !is_time(now)) return SEMBLANTE_INVALID_ARGUMENT;
  return guarded(nullptr, [&] { return to_result(stream->it.publish({frames, count}, media_time, now)); });
}

semblante_result semblante_stream_publish_sound(semblante_stream* stream, const uint8_t* packet, uint32_t size,
                                                double media_time) {
  if (stream == nullptr || packet == nullptr) return SEMBLANTE_INVALID_ARGUMENT;
  return guarded(nullptr, [&] { return to_result(stream->it.publish_sound({packet, size}, media_time)); });
}

}  // extern "C"

#pragma once

#include <array>
#include <cstdint>

#include "server/metrics/histogram.h"
#include "server/streams/source.h"

namespace semblante::streams {

/// Event counts of a stream, or of all streams.
struct StreamCounts {
  std::uint64_t frames = 0;  ///< accepted from sources
  std::array<std::uint64_t, source_count> frames_by_source{};
  std::uint64_t batches = 0;            ///< closed
  std::uint64_t messages_sent = 0;      ///< batches and join points, to each subscriber
  std::uint64_t bytes_sent = 0;         ///< of these, WebSocket headers included
  std::uint64_t messages_replaced = 0;  ///< batches replaced by newer state for slow subscribers
  std::uint64_t messages_dropped = 0;   ///< pending when their connection was closed as slow; answers refused
  std::uint64_t sound_packets = 0;      ///< accepted from sources
  std::uint64_t sound_sent = 0;         ///< messages, to each listener
  std::uint64_t sound_bytes_sent = 0;   ///< of these, WebSocket headers included
  std::uint64_t sound_dropped = 0;      ///< not sent to listeners who read too slowly
  std::uint64_t texts_sent = 0;         ///< sentences, to each client with a voice of its own
  std::uint64_t text_bytes_sent = 0;    ///< of these, WebSocket headers included
  std::uint64_t words_reached = 0;      ///< boundaries that such clients have told
  std::uint64_t voices_failed = 0;      ///< clients whose voice did not speak, which then got frames
  std::uint64_t closed_slow = 0;        ///< subscribers that read nothing
  std::uint64_t closed_silent = 0;      ///< connections that sent no hello
  std::uint64_t closed_replaced = 0;    ///< publishers replaced by another source
  std::uint64_t closed_ended = 0;       ///< connections of streams that ended
  std::uint64_t closed_flooding = 0;    ///< publishers closed by their flood guard
  std::uint64_t closed_conflict = 0;    ///< publishers that came while another source held the stream
  std::uint64_t refused = 0;            ///< connections over the limit
  std::uint64_t throttled = 0;          ///< frames dropped by a flood guard
  std::uint64_t clamped_values = 0;     ///< values outside the range of their FAP
  double encode_seconds = 0.0;          ///< spent on encoding batches and join points, in all codings
  metrics::LatenessValues lateness;     ///< of batches to each subscriber: from deadline to kernel

  StreamCounts& operator+=(const StreamCounts& other) {
    frames += other.frames;
    for (std::size_t i = 0; i < source_count; ++i) frames_by_source[i] += other.frames_by_source[i];
    batches += other.batches;
    messages_sent += other.messages_sent;
    bytes_sent += other.bytes_sent;
    messages_replaced += other.messages_replaced;
    messages_dropped += other.messages_dropped;
    sound_packets += other.sound_packets;
    sound_sent += other.sound_sent;
    sound_bytes_sent += other.sound_bytes_sent;
    sound_dropped += other.sound_dropped;
    texts_sent += other.texts_sent;
    text_bytes_sent += other.text_bytes_sent;
    words_reached += other.words_reached;
    voices_failed += other.voices_failed;
    closed_slow += other.closed_slow;
    closed_silent += other.closed_silent;
    closed_replaced += other.closed_replaced;
    closed_ended += other.closed_ended;
    closed_flooding += other.closed_flooding;
    closed_conflict += other.closed_conflict;
    refused += other.refused;
    throttled += other.throttled;
    clamped_values += other.clamped_values;
    encode_seconds += other.encode_seconds;
    lateness += other.lateness;
    return *this;
  }
};

}  // namespace semblante::streams

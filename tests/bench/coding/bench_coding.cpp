// How few bytes a stream takes, and how long it takes to make and read them: tables on standard output.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <exception>
#include <stdexcept>

#include "protocol/cpp/frame_codec.h"
#include "server/recordings/recording_version_1.h"
#include "tests/bench/coding/training.h"
#include "tests/support/varint_frames.h"

namespace semblante::bench {
namespace {

using Bytes = std::vector<std::uint8_t>;

double seconds(const Trace& trace) {
  const auto& frames = trace.frames;
  const double length = frames.back().time - frames.front().time;
  return length * static_cast<double>(frames.size()) / static_cast<double>(frames.size() - 1) / 1000;
}

struct Coded {
  std::size_t payload = 0;  ///< bytes of messages, the first keyframe among them
  std::size_t messages = 0;
};

/// What one TCP segment and one unmasked WebSocket frame add to each message: IPv4, TCP with timestamps, two bytes.
constexpr std::size_t socket_bytes = 20 + 20 + 12 + 2;

/// The baseline: differences as varints, one message after the other.
std::vector<Bytes> varint_messages(const Keyframe& first, std::span<const Frames> messages) {
  std::vector<Bytes> all = {testing::varint_keyframe(first)};
  const FaceFrame* before = &first.state;
  for (const Frames& batch : messages) {
    all.push_back(testing::varint_frames(batch, *before));
    before = &batch.frames.back().state;
  }
  return all;
}

Coded varint(const Trace& trace, std::size_t per_message) {
  Coded coded;
  for (const Bytes& message : varint_messages(first_frame(trace), batches(trace, per_message))) {
    coded.payload += message.size();
    ++coded.messages;
  }
  return coded;
}

/// Decodes what it encodes, and throws where that is not the same.
Coded packed(const Trace& trace, std::size_t per_message, const PackedTable& table) {
  PackedEncoder encoder(first_frame(trace), table);
  PackedState reader;
  const Bytes start = encoder.keyframe();
  if (!read_packed_keyframe(start, reader, table)) throw std::runtime_error("keyframe refused");
  Coded coded{start.size(), 1};
  for (const Frames& batch : batches(trace, per_message)) {
    const Bytes bytes = encoder.encode(batch);
    Frames read;
    if (!read_packed_frames(bytes, reader, read, table) || !(read == batch))
      throw std::runtime_error("not lossless: " + trace.name);
    coded.payload += bytes.size();
    ++coded.messages;
  }
  return coded;
}

double kbits(double bytes, const Trace& trace) { return bytes * 8 / 1000 / seconds(trace); }
double on_socket(const Coded& coded, const Trace& trace) {
  return kbits(static_cast<double>(coded.payload + socket_bytes * coded.messages), trace);
}

PackedTable without(const std::vector<Trace>& all, const std::string& name) {
  std::vector<Trace> rest;
  std::copy_if(all.begin(), all.end(), std::back_inserter(rest), [&](const Trace& each) { return each.name != name; });
  return trained(rest);
}

void print_payload(const std::vector<Trace>& measured, const std::vector<Trace>& training) {
  std::puts("Payload, kbit/s: messages with type, sequence and media time, the first keyframe among them\n");
  std::puts(
      "| trace | frames a message | raw int16 | varint | packed, trace unseen | packed as shipped | with a join in 10 "
      "s |");
  std::puts("|---|---|---|---|---|---|---|");
  for (const Trace& trace : measured) {
    const PackedTable unseen = without(training, trace.name);
    for (const std::size_t per_message : {5U, 3U, 1U}) {
      const double raw = static_cast<double>(trace.frames.size() * low_level_fap_count * 2);
      const Coded own = packed(trace, per_message, packed_tables::values);
      PackedEncoder encoder(first_frame(trace));
      std::size_t joins = 0;
      double next = trace.frames.front().time + 10'000.0;
      for (const Frames& batch : batches(trace, per_message)) {
        encoder.encode(batch);
        if (static_cast<double>(encoder.media_time()) < next) continue;
        next += 10'000;
        joins += encoder.keyframe().size();
      }
      std::printf("| %s | %zu | %.1f | %.2f | %.3f | %.3f | %.3f |\n", trace.name.c_str(), per_message,
                  kbits(raw, trace), kbits(static_cast<double>(varint(trace, per_message).payload), trace),
                  kbits(static_cast<double>(packed(trace, per_message, unseen).payload), trace),
                  kbits(static_cast<double>(own.payload), trace),
                  kbits(static_cast<double>(own.payload + joins), trace));
    }
  }
}

void print_socket(const std::vector<Trace>& measured, const std::vector<Trace>& training) {
  std::puts("\nOn the socket, kbit/s: and 54 bytes a message (IPv4, TCP with timestamps, WebSocket)\n");
  std::puts("| trace | coding | 40 ms | 100 ms | 200 ms |");
  std::puts("|---|---|---|---|---|");
  for (const Trace& trace : measured) {
    const PackedTable unseen = without(training, trace.name);
    const auto row = [&](const char* name, const auto& code) {
      // A batch of 100 ms at 25 frames a second has two or three frames; three in 120 ms would flatter, two do not.
      std::printf("| %s | %s | %.2f | %.2f | %.2f |\n", trace.name.c_str(), name, on_socket(code(1U), trace),
                  on_socket(code(2U), trace), on_socket(code(5U), trace));
    };
    row("varint", [&](std::size_t n) { return varint(trace, n); });
    row("packed, trace unseen", [&](std::size_t n) { return packed(trace, n, unseen); });
    row("packed as shipped", [&](std::size_t n) { return packed(trace, n, packed_tables::values); });
  }
}

void print_joins(const std::vector<Trace>& measured) {
  std::puts(
      "\nJoin points, bytes: a keyframe in the middle of the stream, from which its reader goes on as all others\n");
  std::puts("| trace | first | median | largest | varint keyframe, median |");
  std::puts("|---|---|---|---|---|");
  for (const Trace& trace : measured) {
    PackedEncoder encoder(first_frame(trace));
    const std::size_t first = encoder.keyframe().size();
    std::vector<std::size_t> sizes;
    std::vector<std::size_t> varints;
    for (const Frames& batch : batches(trace, 5)) {
      encoder.encode(batch);
      sizes.push_back(encoder.keyframe().size());
      varints.push_back(
          testing::varint_keyframe(Keyframe{encoder.sequence(), encoder.media_time(), encoder.state()}).size());
    }
    std::sort(sizes.begin(), sizes.end());
    std::sort(varints.begin(), varints.end());
    std::printf("| %s | %zu | %zu | %zu | %zu |\n", trace.name.c_str(), first, sizes[sizes.size() / 2], sizes.back(),
                varints[varints.size() / 2]);
  }
}

/// Processor time of this thread, the best of several turns: microseconds a frame.
template <class Run>
double microseconds(const Trace& trace, const Run& run) {
  double best = 1e9;
  const int turns = trace.frames.size() < 500 ? 100 : 15;
  for (int turn = 0; turn < turns; ++turn) {
    timespec from{};
    timespec to{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &from);
    run();
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &to);
    best = std::min(best, static_cast<double>(to.tv_sec - from.tv_sec) * 1e6 +
                              static_cast<double>(to.tv_nsec - from.tv_nsec) / 1e3);
  }
  return best / static_cast<double>(trace.frames.size());
}

void print_times(const std::vector<Trace>& measured) {
  std::puts("\nProcessor time, us a frame, five frames a message\n");
  std::puts("| trace | varint encode | packed encode | times | varint decode | packed decode | times |");
  std::puts("|---|---|---|---|---|---|---|");
  for (const Trace& trace : measured) {
    const auto messages = batches(trace, 5);
    const Keyframe first = first_frame(trace);
    const std::vector<Bytes> varint_bytes = varint_messages(first, messages);
    std::vector<Bytes> packed_bytes;
    PackedEncoder packed_encoder(first);
    packed_bytes.push_back(packed_encoder.keyframe());
    for (const Frames& batch : messages) packed_bytes.push_back(packed_encoder.encode(batch));
    const double varint_encode = microseconds(trace, [&] { varint_messages(first, messages); });
    const double packed_encode = microseconds(trace, [&] {
      PackedEncoder encoder(first);
      for (const Frames& batch : messages) encoder.encode(batch);
    });
    Frames read;
    const double varint_decode = microseconds(trace, [&] {
      recordings::Version1Decoder decoder;
      if (!decoder.keyframe(varint_bytes[0])) throw std::runtime_error("refused");
      for (std::size_t i = 1; i < varint_bytes.size(); ++i) {
        if (!decoder.frames(varint_bytes[i], read)) throw std::runtime_error("refused");
      }
    });
    const double packed_decode = microseconds(trace, [&] {
      FrameDecoder decoder;
      if (!decoder.decode(packed_bytes[0])) throw std::runtime_error("refused");
      for (std::size_t i = 1; i < packed_bytes.size(); ++i) {
        if (!decoder.decode_frames(packed_bytes[i], read)) throw std::runtime_error("refused");
      }
    });
    std::printf("| %s | %.2f | %.2f | %.1f | %.2f | %.2f | %.1f |\n", trace.name.c_str(), varint_encode, packed_encode,
                packed_encode / varint_encode, varint_decode, packed_decode, packed_decode / varint_decode);
  }
}

void run() {
  auto training = samples();
  auto measured = training;
  if (measured.empty()) std::puts("no samples: set SEMBLANTE_SAMPLES_DIR\n");
  measured.push_back(talking_minute(SEMBLANTE_SOURCE_DIR));
  for (auto& trace : made_up_traces()) training.push_back(std::move(trace));
  measured.push_back(live_capture(11));
  print_payload(measured, training);
  print_socket(measured, training);
  print_joins(measured);
  print_times(measured);
}

}  // namespace
}  // namespace semblante::bench

int main() {
  try {
    semblante::bench::run();
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "bench_coding: %s\n", fault.what());
    return 1;
  }
  return 0;
}

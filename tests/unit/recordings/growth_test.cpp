// A recording is opened and walked through in time in proportion to its bytes.

#include "tests/support/growth.h"

#include <functional>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "server/recordings/recording_reader.h"
#include "tests/unit/recordings/recorded_frames.h"

namespace semblante::recordings {
namespace {

using Bytes = std::vector<std::uint8_t>;

void read_all(const Bytes& bytes) {
  for (const Check check : {Check::heads, Check::everything}) {
    const auto reader = RecordingReader::open(bytes_in_memory(bytes), check);
    if (!reader) continue;
    const auto shared = std::make_shared<const RecordingReader>(*reader);
    RecordingCursor cursor(shared, 0);
    while (cursor.frame() != nullptr) cursor.advance();
    for (std::uint32_t part = 0; part < 8; ++part) (void)shared->at(shared->duration() / 8 * part);
  }
}

/// A recording of n frames, `each` in a chunk.
std::function<Bytes(std::size_t)> recording(std::size_t each) {
  return [each](std::size_t n) {
    const auto frames = random_frames(n, 1);
    auto bytes = encode_beginning(stream_header());
    for (std::size_t i = 0; i < n; i += each) {
      const auto chunk = encode_chunk(std::span(frames).subspan(i, std::min(each, n - i)), 0);
      bytes.insert(bytes.end(), chunk.begin(), chunk.end());
    }
    return bytes;
  };
}

TEST(RecordingGrowth, Chunks) {
  test::expect_linear("chunks of one frame", {.from = 100, .most = 100'000}, recording(1), read_all);
  test::expect_linear("large chunks", {.from = 100, .most = 100'000}, recording(max_chunk_frames), read_all);
}

TEST(RecordingGrowth, BytesThatAreNoChunk) {
  test::expect_linear(
      "magic words", {.from = 1000, .most = 4'000'000},
      [](std::size_t n) {
        auto bytes = recording(10)(10);
        for (std::size_t i = 0; i < n; ++i) bytes.insert(bytes.end(), chunk_magic.begin(), chunk_magic.end());
        return bytes;
      },
      read_all);
}

}  // namespace
}  // namespace semblante::recordings

#include <cstdlib>
#include <vector>
#include <zlib.h>

#include "protocol/cpp/inflate.h"

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t most_bytes = 1U << 14U;

void expect(bool fact) {
  if (!fact) std::abort();
}

struct Unpacked {
  bool is_complete = false;
  std::size_t consumed = 0;
  Bytes raw;
};

/// At most most_bytes, by zlib. `window_bits` below 0: without header and checksum.
Unpacked reference(const Bytes& packed, int window_bits) {
  Unpacked result;
  result.raw.resize(most_bytes);
  z_stream stream{};
  expect(inflateInit2(&stream, window_bits) == Z_OK);
  Bytes input = packed;
  input.push_back(0);  // never null
  stream.next_in = input.data();
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = result.raw.data();
  stream.avail_out = static_cast<uInt>(result.raw.size());
  result.is_complete = inflate(&stream, Z_FINISH) == Z_STREAM_END;
  result.consumed = packed.size() - stream.avail_in;
  result.raw.resize(stream.total_out);
  inflateEnd(&stream);
  return result;
}

void compare(const Bytes& packed) {
  const Unpacked expected = reference(packed, 15);
  // The size of the allocation is that of the content: nothing is written beyond.
  Bytes raw(expected.raw.size());
  const bool taken = semblante::inflate_zlib(packed, raw);
  expect(taken == (expected.is_complete && expected.consumed == packed.size()));
  if (!taken) return;
  expect(raw == expected.raw);
  raw.push_back(0);
  expect(!semblante::inflate_zlib(packed, raw));
  if (raw.size() < 2) return;
  raw.resize(raw.size() - 2);
  raw.shrink_to_fit();
  expect(!semblante::inflate_zlib(packed, raw));
  Bytes longer = packed;
  longer.push_back(0);
  raw.resize(expected.raw.size());
  expect(!semblante::inflate_zlib(longer, raw));
  longer.resize(packed.size() - 1);
  expect(!semblante::inflate_zlib(longer, raw));
}

}  // namespace

/// Beside zlib's inflate: the input as it is, and its blocks with a valid header and the checksum of what they hold, or
/// no change would get past them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Bytes input(data, data + size);
  expect(semblante::crc32(7, input) == ::crc32_z(7, data, size));
  compare(input);
  if (size < 2) return 0;
  const Bytes blocks(input.begin() + 2, input.end());
  const Unpacked content = reference(blocks, -15);
  Bytes mended = {0x78, 0x9C};
  mended.insert(mended.end(), blocks.begin(), blocks.begin() + static_cast<std::ptrdiff_t>(content.consumed));
  const uLong sum = adler32_z(1, content.raw.data(), content.raw.size());
  for (int shift = 24; shift >= 0; shift -= 8) mended.push_back(static_cast<std::uint8_t>(sum >> shift));
  compare(mended);
  return 0;
}

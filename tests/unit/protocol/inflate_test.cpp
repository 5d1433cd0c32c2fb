#include "protocol/cpp/inflate.h"

#include <random>
#include <vector>
#include <zlib.h>

#include <gtest/gtest.h>

namespace semblante {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes packed(const Bytes& raw, int level, int strategy, int window_bits) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, level, Z_DEFLATED, window_bits, 8, strategy), Z_OK);
  Bytes out(deflateBound(&stream, raw.size()) + 64);
  stream.next_in = const_cast<Bytef*>(raw.data());
  stream.avail_in = static_cast<uInt>(raw.size());
  stream.next_out = out.data();
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

/// Text-like, noisy, constant and empty contents.
std::vector<Bytes> contents() {
  std::mt19937 random(3);
  std::vector<Bytes> all = {{}, {7}, Bytes(100'000, 9)};
  for (const unsigned range : {2U, 5U, 60U, 256U}) {
    Bytes bytes;
    for (int i = 0; i < 70'000; ++i) {
      bytes.push_back(static_cast<std::uint8_t>(random() % range));
      if (random() % 64 == 0 && bytes.size() > 3000) {
        const std::size_t from = bytes.size() - 1 - random() % 3000;
        const std::size_t count = random() % 300;
        for (std::size_t k = 0; k < count; ++k) bytes.push_back(bytes[from + k]);
      }
    }
    all.push_back(bytes);
  }
  return all;
}

TEST(Inflate, GivesBackWhatZlibPacked) {
  for (const Bytes& raw : contents()) {
    for (const int level : {0, 1, 6, 9}) {
      for (const int strategy : {Z_DEFAULT_STRATEGY, Z_HUFFMAN_ONLY, Z_RLE, Z_FIXED}) {
        for (const int window_bits : {9, 15}) {
          const Bytes file = packed(raw, level, strategy, window_bits);
          Bytes out(raw.size());
          ASSERT_TRUE(inflate_zlib(file, out)) << level << ' ' << strategy << ' ' << window_bits;
          ASSERT_EQ(out, raw);
        }
      }
    }
    EXPECT_EQ(crc32(0, raw), ::crc32(0, raw.data(), static_cast<uInt>(raw.size())));
  }
}

TEST(Inflate, AnotherSize_IsRefused) {
  const Bytes raw = contents()[4];
  const Bytes file = packed(raw, 6, Z_DEFAULT_STRATEGY, 15);
  for (const std::size_t size : {raw.size() - 1, raw.size() + 1, std::size_t{0}}) {
    Bytes out(size);
    EXPECT_FALSE(inflate_zlib(file, out)) << size;
  }
  Bytes longer = file;
  longer.push_back(0);
  Bytes out(raw.size());
  EXPECT_FALSE(inflate_zlib(longer, out)) << "a byte after the stream";
}

/// Every cut is refused; every damaged byte gives what zlib says of it.
TEST(Inflate, DamagedBytes_AreTakenExactlyWhereZlibTakesThem) {
  std::mt19937 random(5);
  Bytes raw;
  for (int i = 0; i < 600; ++i) raw.push_back(static_cast<std::uint8_t>(random() % 9));
  for (const int strategy : {Z_DEFAULT_STRATEGY, Z_FIXED}) {
    const Bytes file = packed(raw, 6, strategy, 15);
    for (std::size_t size = 0; size < file.size(); ++size) {
      Bytes out(raw.size());
      EXPECT_FALSE(inflate_zlib(std::span(file).first(size), out)) << size;
    }
    for (int i = 0; i < 20'000; ++i) {
      Bytes damaged = file;
      for (unsigned flips = 1 + random() % 3; flips > 0; --flips)
        damaged[random() % damaged.size()] ^= static_cast<std::uint8_t>(1U << random() % 8);
      Bytes out(raw.size());
      Bytes expected(raw.size());
      uLongf size = expected.size();
      uLong consumed = damaged.size();
      const bool taken = uncompress2(expected.data(), &size, damaged.data(), &consumed) == Z_OK && size == raw.size() &&
                         consumed == damaged.size();
      ASSERT_EQ(inflate_zlib(damaged, out), taken);
      if (taken) {
        ASSERT_EQ(out, expected);
      }
    }
  }
}

/// Without the checksum as a guard: what is unpacked is what zlib unpacks, or both refuse.
TEST(Inflate, RandomBlocks_NeverDifferFromZlib) {
  std::mt19937 random(6);
  for (int i = 0; i < 100'000; ++i) {
    Bytes file = {0x78, 0x9C};
    for (unsigned count = random() % 40; count > 0; --count) file.push_back(static_cast<std::uint8_t>(random()));
    file[2 % file.size()] =
        file.size() > 2 ? static_cast<std::uint8_t>((file[2] & 0xF8U) | 1U | (random() % 3) << 1U) : file[0];
    Bytes expected(4096);
    z_stream stream{};
    inflateInit(&stream);
    stream.next_in = file.data();
    stream.avail_in = static_cast<uInt>(file.size());
    stream.next_out = expected.data();
    stream.avail_out = static_cast<uInt>(expected.size());
    inflate(&stream, Z_FINISH);
    // The end of the data was reached if zlib wants or has judged the checksum.
    expected.resize(stream.total_out);
    const uLong adler = adler32(1, expected.data(), static_cast<uInt>(expected.size()));
    inflateEnd(&stream);
    Bytes with_sum(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(file.size() - stream.avail_in));
    for (std::size_t cut = 0; cut <= 4 && cut + 2 < with_sum.size(); ++cut) {
      Bytes tried(with_sum.begin(), with_sum.end() - static_cast<std::ptrdiff_t>(cut));
      for (int shift = 24; shift >= 0; shift -= 8) tried.push_back(static_cast<std::uint8_t>(adler >> shift));
      Bytes again(expected.size());
      uLongf size = again.size();
      uLong consumed = tried.size();
      Bytef none = 0;
      const bool taken = uncompress2(again.empty() ? &none : again.data(), &size, tried.data(), &consumed) == Z_OK &&
                         size == again.size() && consumed == tried.size();
      Bytes out(expected.size());
      ASSERT_EQ(inflate_zlib(tried, out), taken);
      if (taken) {
        ASSERT_EQ(out, again);
      }
    }
  }
}

}  // namespace
}  // namespace semblante

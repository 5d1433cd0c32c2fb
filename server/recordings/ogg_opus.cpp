#include "server/recordings/ogg_opus.h"

#include <array>
#include <cassert>
#include <cmath>
#include <ostream>
#include <string_view>

#include <ogg/ogg.h>

#include "protocol/cpp/byte_io.h"
#include "protocol/cpp/opus_packet.h"

namespace semblante::recordings {
namespace {

constexpr std::int64_t samples_per_ms = 48;  ///< of granule positions, for every rate of the sound
constexpr std::int64_t most_overlap = 10 * samples_per_ms;
constexpr int serial_number = 1;  ///< the only stream of its file

/// A packet of silence: a CELT frame of full band, one channel, with the flag for silence (RFC 6716, 4.3).
struct Silence {
  std::array<std::uint8_t, 3> packet;
  std::int64_t samples;
};
constexpr std::array<Silence, 4> silences = {
    {{{0xF8, 0xFF, 0xFE}, 960}, {{0xF0, 0xFF, 0xFE}, 480}, {{0xE8, 0xFF, 0xFE}, 240}, {{0xE0, 0xFF, 0xFE}, 120}}};

std::vector<std::uint8_t> text_bytes(std::string_view text) { return {text.begin(), text.end()}; }

void append_u32(std::vector<std::uint8_t>& to, std::uint32_t value) {
  to.resize(to.size() + 4);
  byte_io::put_u32(&to[to.size() - 4], value);
}

/// RFC 7845, 5.1.
std::vector<std::uint8_t> id_header(unsigned channels) {
  auto head = text_bytes("OpusHead");
  head.push_back(1);  // version
  head.push_back(static_cast<std::uint8_t>(channels));
  head.insert(head.end(), {0, 0});  // pre-skip: packets begin with what is heard, SPEC.md 2.1
  append_u32(head, 48'000);
  head.insert(head.end(), {0, 0, 0});  // gain, mapping family
  return head;
}

/// RFC 7845, 5.2.
std::vector<std::uint8_t> comment_header() {
  constexpr std::string_view vendor = "Semblante";
  auto tags = text_bytes("OpusTags");
  append_u32(tags, static_cast<std::uint32_t>(vendor.size()));
  tags.insert(tags.end(), vendor.begin(), vendor.end());
  append_u32(tags, 0);
  return tags;
}

}  // namespace

struct OggOpusWriter::Muxer {
  Muxer() {
    [[maybe_unused]] const int made = ogg_stream_init(&state, serial_number);
    assert(made == 0);
  }
  ~Muxer() { ogg_stream_clear(&state); }
  Muxer(const Muxer&) = delete;
  Muxer& operator=(const Muxer&) = delete;
  ogg_stream_state state{};
};

OggOpusWriter::OggOpusWriter(std::ostream& to, unsigned channels) : to_(to), muxer_(std::make_unique<Muxer>()) {
  for (auto header : {id_header(channels), comment_header()}) {
    pending_ = std::move(header);
    put(false);
    write_pages(true);  // each header has a page of its own (RFC 7845, 3)
  }
}

OggOpusWriter::~OggOpusWriter() = default;

void OggOpusWriter::add(std::uint64_t ms, std::span<const std::uint8_t> packet) {
  const auto begin = static_cast<std::int64_t>(ms) * samples_per_ms;
  if (position_ - begin > most_overlap) return;
  for (const auto& silence : silences)
    while (begin - position_ >= silence.samples) append(silence.packet, silence.samples);
  const auto length = opus_packet_ms(packet);
  assert(length);
  append(packet, std::llround(length.value_or(0.0) * samples_per_ms));
}

void OggOpusWriter::append(std::span<const std::uint8_t> packet, std::int64_t samples) {
  if (!pending_.empty()) put(false);
  pending_.assign(packet.begin(), packet.end());
  position_ += samples;
}

void OggOpusWriter::put(bool is_last) {
  ogg_packet packet{};
  packet.packet = pending_.data();
  packet.bytes = static_cast<long>(pending_.size());
  packet.b_o_s = packets_ == 0 ? 1 : 0;
  packet.e_o_s = is_last ? 1 : 0;
  packet.packetno = packets_++;
  packet.granulepos = position_;
  ogg_stream_packetin(&muxer_->state, &packet);
  pending_.clear();
  write_pages(is_last);
}

void OggOpusWriter::finish() {
  if (!pending_.empty()) put(true);
}

void OggOpusWriter::write_pages(bool all) {
  ogg_page page{};
  while ((all ? ogg_stream_flush(&muxer_->state, &page) : ogg_stream_pageout(&muxer_->state, &page)) != 0) {
    to_.write(reinterpret_cast<const char*>(page.header), page.header_len);
    to_.write(reinterpret_cast<const char*>(page.body), page.body_len);
    bytes_ += static_cast<std::uint64_t>(page.header_len) + static_cast<std::uint64_t>(page.body_len);
  }
}

}  // namespace semblante::recordings

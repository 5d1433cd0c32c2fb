#include <cstdlib>
#include <cstring>
#include <iterator>
#include <vector>
#include <zlib.h>

#include "protocol/cpp/byte_io.h"
#include "protocol/cpp/weights_format.h"
#include "protocol/cpp/weights_layout.h"

using namespace semblante;

namespace {

/// The encoder leaves out the shares of a head that turns as a whole.
std::vector<std::uint8_t> turns_of(const InfluenceTable& table) {
  return table.turn.empty() ? std::vector<std::uint8_t>(table.rigid.size(), weights_layout::full_turn) : table.turn;
}

}  // namespace

/// The input is header and INFLATED payload: packing and checksum are done here, or no change would get past them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace layout = weights_layout;
  static_cast<void>(decode_weights({data, size}));
  if (size < layout::header_bytes) return 0;
  std::vector<std::uint8_t> bytes(layout::header_bytes + compressBound(size - layout::header_bytes));
  uLongf packed = bytes.size() - layout::header_bytes;
  compress2(&bytes[layout::header_bytes], &packed, data + layout::header_bytes, size - layout::header_bytes, 1);
  bytes.resize(layout::header_bytes + packed);
  std::memcpy(bytes.data(), data, layout::header_bytes);
  std::memcpy(bytes.data(), layout::magic, sizeof(layout::magic));
  // Each version of a seed stays itself.
  constexpr std::uint16_t versions[] = {layout::version_of_turns, layout::version_of_eyes, layout::version_of_parts};
  byte_io::put_u16(&bytes[layout::at_version], versions[data[layout::at_version] % std::size(versions)]);
  bytes[layout::at_reserved] = 0;
  byte_io::put_u32(&bytes[layout::at_raw_bytes], static_cast<std::uint32_t>(size - layout::header_bytes));
  byte_io::put_u32(&bytes[layout::at_packed_bytes], static_cast<std::uint32_t>(packed));
  byte_io::put_u32(&bytes[layout::at_crc], 0);
  byte_io::put_u32(&bytes[layout::at_crc], static_cast<std::uint32_t>(crc32_z(0, bytes.data(), bytes.size())));

  const auto table = decode_weights(bytes);
  if (!table) return 0;
  const auto echo = decode_weights(encode_weights(*table, {bytes[layout::at_bits]}));
  if (!echo || echo->rows.points != table->rows.points || echo->rigid != table->rigid) std::abort();
  if (turns_of(*echo) != turns_of(*table)) std::abort();
  if (max_quantization_error(*table, *echo) > 1.0 / 255) std::abort();
  return 0;
}

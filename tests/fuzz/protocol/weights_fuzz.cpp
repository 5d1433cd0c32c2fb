#include <cstdlib>
#include <cstring>
#include <zlib.h>

#include "protocol/cpp/byte_io.h"
#include "protocol/cpp/weights_format.h"
#include "protocol/cpp/weights_layout.h"

using namespace semblante;

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
  byte_io::put_u16(&bytes[layout::at_version],
                   data[layout::at_version] % 2 == 0 ? layout::version_of_eyes : layout::version_of_all_parts);
  bytes[layout::at_reserved] = 0;
  byte_io::put_u32(&bytes[layout::at_raw_bytes], static_cast<std::uint32_t>(size - layout::header_bytes));
  byte_io::put_u32(&bytes[layout::at_packed_bytes], static_cast<std::uint32_t>(packed));
  byte_io::put_u32(&bytes[layout::at_crc], 0);
  byte_io::put_u32(&bytes[layout::at_crc], static_cast<std::uint32_t>(crc32_z(0, bytes.data(), bytes.size())));

  const auto table = decode_weights(bytes);
  if (!table) return 0;
  const auto echo = decode_weights(encode_weights(*table, {bytes[layout::at_bits]}));
  if (!echo || echo->rows.points != table->rows.points || echo->rigid != table->rigid) std::abort();
  if (max_quantization_error(*table, *echo) > 1.0 / 255) std::abort();
  return 0;
}

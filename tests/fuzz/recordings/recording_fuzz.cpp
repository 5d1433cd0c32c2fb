#include <cstdlib>
#include <sstream>
#include <zlib.h>

#include "protocol/cpp/byte_io.h"
#include "server/recordings/recording_export.h"
#include "server/recordings/recording_reader.h"

using namespace semblante;
using namespace semblante::recordings;

namespace {

/// Makes checksums right, chunk by chunk, so that what is behind them is seen too.
void mend(std::vector<std::uint8_t>& bytes) {
  std::size_t at = file_magic.size();
  while (at + chunk_head_bytes <= bytes.size()) {
    const std::size_t length = byte_io::get_u32(&bytes[at + 4]);
    if (length > bytes.size() - at - chunk_head_bytes) return;
    byte_io::put_u32(&bytes[at + 8],
                     static_cast<std::uint32_t>(crc32_z(0, &bytes[at + 12], chunk_head_bytes - 12 + length)));
    at += chunk_head_bytes + length;
  }
}

/// A longer pause in the sound takes more time than it teaches.
constexpr std::uint64_t most_exported_ms = 60'000;

void walk(std::vector<std::uint8_t> bytes, Check check) {
  const auto reader = RecordingReader::open(bytes_in_memory(std::move(bytes)), check);
  if (!reader) return;
  const auto shared = std::make_shared<const RecordingReader>(*reader);
  std::uint64_t frames = 0;
  std::uint32_t time = 0;
  RecordingCursor cursor(shared, 0);
  for (; cursor.frame() != nullptr; cursor.advance(), ++frames) {
    if (cursor.time() < time) std::abort();
    time = cursor.time();
  }
  if (check == Check::everything && (cursor.error() || frames != reader->frames() || time != reader->duration()))
    std::abort();
  std::uint64_t packets = 0, sound_time = 0;
  RecordingSoundCursor sound(shared, 0);
  for (; sound.packet() != nullptr; sound.advance(), ++packets) {
    if (sound.packet()->media_time < sound_time) std::abort();
    sound_time = sound.packet()->media_time;
  }
  if (check == Check::everything && (sound.error() || packets != reader->sound_packets())) std::abort();
  // read_text_chunk(), of each chunk of text.
  const auto texts = shared->texts();
  if (check == Check::everything && !texts) std::abort();
  for (std::size_t i = 0; texts && i < texts->size(); ++i) {
    const std::uint64_t at = (*texts)[i].media_time;
    if (at > shared->duration() || (i > 0 && at <= (*texts)[i - 1].media_time)) std::abort();
  }
  std::ostringstream ogg;
  if (sound_time < most_exported_ms) static_cast<void>(export_sound(shared, {}, ogg).ok());
  const auto middle = reader->at(reader->duration() / 2);
  if (check == Check::everything && (!middle || middle->has_value() != (frames > 0))) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::uint8_t> bytes(data, data + size);
  walk(bytes, Check::heads);
  mend(bytes);
  walk(bytes, Check::everything);
  walk(std::move(bytes), Check::heads);
  return 0;
}

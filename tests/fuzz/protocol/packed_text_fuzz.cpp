// A packed text. What is accepted is packed again, into the same bytes but for numbers that were written longer than
// needed.
#include <cstdlib>

#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/packed_text.h"
#include "protocol/cpp/speech_score.h"

using namespace semblante;

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::uint8_t> bytes = {packed_text_type};
  bytes.insert(bytes.end(), data, data + size);
  const auto text = read_packed_text(bytes);
  require(FrameDecoder().decode_from_server(bytes).ok() == text.ok());
  if (!text) return 0;
  require(text->language.size() <= 64 && text->text.size() <= max_speech_text_bytes);
  require(text->score.size() <= max_score_bytes && check_text(*text));
  std::vector<std::uint8_t> again;
  write_packed_text(*text, again);
  require(again.size() <= bytes.size());
  const auto same = read_packed_text(again);
  require(same && *same == *text);
  return 0;
}

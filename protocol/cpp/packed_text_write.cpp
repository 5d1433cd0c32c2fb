#include <cassert>
#include <memory>

#include "protocol/cpp/byte_io.h"
#include "protocol/cpp/packed_text.h"
#include "protocol/cpp/range_coder.h"
#include "protocol/cpp/text_model.h"

namespace semblante {

void write_packed_text(const SpeechText& text, std::vector<std::uint8_t>& to) {
  assert(check_text(text));
  to.push_back(packed_text_type);
  byte_io::append_varint(to, text.speech);
  byte_io::append_varint(to, text.media_time);
  const auto memory = std::make_unique<text_model::Memory>(text_model::primed());
  RangeEncoder coder(to);
  SpeechText coded = text;
  text_model::TextModel(coder, *memory).message(coded);
  coder.finish();
}

}  // namespace semblante

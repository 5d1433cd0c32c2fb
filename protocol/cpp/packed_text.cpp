#include "protocol/cpp/packed_text.h"

#include <cassert>
#include <memory>
#include <string>

#include "protocol/cpp/byte_io.h"
#include "protocol/cpp/generated/text_prime.h"
#include "protocol/cpp/packed_state.h"
#include "protocol/cpp/range_coder.h"
#include "protocol/cpp/text_model.h"
#include "protocol/cpp/utf8.h"

namespace semblante {

using text_model::Memory;
using text_model::TextModel;

const Memory& text_model::primed() {
  static const auto memory = [] {
    auto learned = std::make_unique<Memory>();
    RangeDecoder coder(text_prime);
    TextModel model(coder, *learned);
    for (std::size_t i = 0; i < text_prime_count; ++i) {
      SpeechText known;
      [[maybe_unused]] const auto wrong = model.message(known);
      assert(wrong.empty());
    }
    assert(!coder.truncated() && !coder.has_more());
    return learned;
  }();
  return *memory;
}

Result<SpeechText> read_packed_text(std::span<const std::uint8_t> bytes) {
  byte_io::Reader reader(bytes);
  reader.u8();
  SpeechText text;
  for (const auto& [where, number] : {std::pair{"/speech", &text.speech}, std::pair{"/media_time", &text.media_time}}) {
    *number = reader.varint();
    if (reader.failed()) return Error{ErrorCode::truncated, where, "the message ends within this field"};
    if (*number > max_media_time) return Error{ErrorCode::out_of_range, where, "must be at most 2^53 - 1"};
  }
  RangeDecoder coder(bytes.subspan(reader.position()));
  const auto memory = std::make_unique<Memory>(text_model::primed());
  const auto wrong = TextModel(coder, *memory).message(text);
  if (!coder.valid()) return Error{ErrorCode::malformed, "/text", "is not the start of a packed text"};
  if (coder.truncated()) return Error{ErrorCode::truncated, "/text", "the message ends within a packed text"};
  if (!wrong.empty()) return Error{ErrorCode::malformed, std::string(wrong), "is too long, or no part of a text"};
  if (coder.has_more()) return Error{ErrorCode::malformed, "/text", "bytes after the end"};
  for (const auto& [where, part] : {std::pair{"/language", &text.language}, std::pair{"/text", &text.text}})
    if (!is_utf8({reinterpret_cast<const std::uint8_t*>(part->data()), part->size()}))
      return Error{ErrorCode::malformed, where, "must be UTF-8"};
  if (auto status = check_text(text); !status) return std::move(status).error();
  return text;
}

}  // namespace semblante

#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/speech/marked_ssml.h"
#include "core/types/printable.h"

// What a document says is no longer than it, its emotions lie within, and every character of the document has its place
// there.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace semblante;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto ssml = read_marked_ssml(text);
  if (!ssml) {
    if (ssml.error().message.empty()) std::abort();
    return 0;
  }
  if (ssml->said.text.size() > text.size()) std::abort();
  std::size_t characters = 0, said = 0;
  for (std::size_t at = 0; at < ssml->document.size(); ++characters)
    at += utf8_step(std::string_view(ssml->document).substr(at));
  for (std::size_t at = 0; at < ssml->said.text.size(); ++said)
    at += utf8_step(std::string_view(ssml->said.text).substr(at));
  if (ssml->places.size() != characters + 1 || ssml->places.back() != said) std::abort();
  for (std::size_t i = 1; i < ssml->places.size(); ++i)
    if (ssml->places[i] < ssml->places[i - 1]) std::abort();
  for (const EmotionSpan& span : ssml->said.emotions)
    if (span.expression < 1 || span.expression > 6 || span.range.first + span.range.count > said) std::abort();
  // Two parts say what the whole says.
  const auto parts = first_part_of_ssml(text);
  if (!parts.rest.empty()) {
    const auto first = read_marked_ssml(parts.first), rest = read_marked_ssml(parts.rest);
    if (!first || !rest || first->said.text + rest->said.text != ssml->said.text) std::abort();
    if (parts.rest.size() >= text.size()) std::abort();
  }
  // The voice sees no emotion any more.
  if (const auto again = read_marked_ssml(ssml->document); !again || !again->said.emotions.empty()) std::abort();
  return 0;
}

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/speech/marked_text.h"

// Marks only take away, and what they say lies within the text that is left.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace semblante;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto marked = read_marked_text(text);
  if (!marked) {
    if (marked.error().message.empty()) std::abort();
    return 0;
  }
  if (marked->text.size() > text.size()) std::abort();
  for (const EmotionSpan& span : marked->emotions) {
    if (span.expression < 1 || span.expression > 6 || !(span.intensity >= 0.0 && span.intensity <= 1.0)) std::abort();
    // A character has at least one byte.
    if (span.range.first > marked->text.size() || span.range.count > marked->text.size() - span.range.first)
      std::abort();
  }
  // Its parts are texts as well, and say no more than it.
  const auto parts = first_part(text);
  if (!parts) std::abort();
  const auto first = read_marked_text(parts->first), rest = read_marked_text(parts->rest);
  if (!first || !rest || first->text.size() + rest->text.size() > marked->text.size() ||
      first->text.empty() != marked->text.empty())
    std::abort();
  const Prosody prosody = prosody_of(*marked);
  if (!std::isfinite(prosody.rate) || !std::isfinite(prosody.pitch) || prosody.rate <= 0.0 || prosody.pitch <= 0.0)
    std::abort();
  return 0;
}

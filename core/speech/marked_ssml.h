#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/speech/marked_text.h"
#include "core/speech/utterance.h"
#include "core/types/result.h"

namespace semblante {

/// A document of SSML for a voice, and what it says.
struct MarkedSsml {
  std::string document;  ///< without emotions
  MarkedText said;       ///< the text without tags, and the emotions over it
  /// For each character of the document, and for its end: the number of characters of the text before it.
  std::vector<std::size_t> places;
};

/// Takes the emotions out of SSML. <emotion name="joy" intensity="0.5"> becomes a <prosody> with the rate and the pitch
/// of the emotion; <prosody rate="slow" emotion="sadness"> loses its attributes `emotion` and `intensity`. Everything
/// else stays as it is. Errors name the byte.
Result<MarkedSsml> read_marked_ssml(std::string_view text);

/// Cuts a document as first_part() cuts a text, outside all elements but speak, p, prosody and emotion, and after
/// `long_part_letters` also in s, say-as, emphasis, voice and lang; they are closed in the first part and opened
/// again in the rest. Without such a place, and of a document that does not nest, the first part is the whole.
TextParts first_part_of_ssml(std::string_view text);

/// The words and sentences of an utterance of the document, at their places in the text.
void place_in_text(const MarkedSsml& ssml, Utterance& utterance);

}  // namespace semblante

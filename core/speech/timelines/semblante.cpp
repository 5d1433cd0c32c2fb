#include <algorithm>
#include <string>
#include <utility>

#include "core/speech/timelines/formats.h"
#include "core/speech/timelines/timeline_json.h"
#include "core/types/printable.h"

namespace semblante {

void read_semblante(std::string_view file, TimelineBuilder& builder) {
  read_object(file, builder, [&](const JsonCursor& root) {
    for (const JsonCursor& phoneme : root.member("phonemes").elements(1, max_timeline_events)) {
      const std::string stress = phoneme.text_or("stress", "none");
      const auto* const at = std::find(stress_names.begin(), stress_names.end(), stress);
      if (at == stress_names.end())
        phoneme.fail(ErrorCode::out_of_range, "the stress must be none, primary or secondary");
      SpokenPhoneme sound{phoneme.member("time").number(0.0, most_timeline_ms),
                          printable(phoneme.member("ipa").text(most_symbol_bytes)),
                          static_cast<Stress>(at - stress_names.begin())};
      const double end = phoneme.member("end").number(0.0, most_timeline_ms);
      if (root.failed() || builder.failed()) return;
      builder.stressed_sound(std::move(sound), end, phoneme.pointer());
    }
    // Places are those of the text: a file without it names its words alone.
    const auto whole = root.optional_member("text");
    if (whole) builder.whole_text(whole->text(max_utterance_text_bytes));
    if (const auto words = root.optional_member("words"))
      for (const JsonCursor& word : words->elements(0, max_timeline_events)) {
        const double time = word.member("time").number(0.0, most_timeline_ms);
        const std::string text = word.member("text").text(most_text_bytes);
        const auto first = whole ? word.member("first").integer(0, max_utterance_text_bytes) : 0;
        if (root.failed() || builder.failed()) return;
        if (whole)
          builder.placed_word(time, text, static_cast<std::size_t>(first), word.pointer());
        else
          builder.word(time, text, word.pointer());
      }
    if (const auto sentences = root.optional_member("sentences"); sentences && whole)
      for (const JsonCursor& sentence : sentences->elements(0, max_timeline_events)) {
        const double time = sentence.member("time").number(0.0, most_timeline_ms);
        const auto first = sentence.member("first").integer(0, max_utterance_text_bytes);
        if (root.failed() || builder.failed()) return;
        builder.placed_sentence(time, static_cast<std::size_t>(first), sentence.pointer());
      }
    if (const auto marks = root.optional_member("marks"))
      for (const JsonCursor& mark : marks->elements(0, max_timeline_events)) {
        const double time = mark.member("time").number(0.0, most_timeline_ms);
        const std::string name = mark.member("name").text(most_text_bytes);
        if (root.failed() || builder.failed()) return;
        builder.mark(time, name, mark.pointer());
      }
    if (const auto duration = root.optional_member("duration")) {
      const double end = duration->number(0.0, most_timeline_ms);
      if (!root.failed()) builder.reach(end);
    }
  });
}

}  // namespace semblante

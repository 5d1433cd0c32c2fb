#include <algorithm>
#include <string>
#include <utility>

#include "core/speech/timelines/formats.h"
#include "core/speech/timelines/timeline_json.h"
#include "core/types/printable.h"

namespace semblante {

namespace {

bool has_failed(const JsonCursor& cursor, const TimelineBuilder& builder) {
  return cursor.failed() || builder.failed();
}

/// Returns whether all went well, as the functions below do.
bool read_json_phonemes(const JsonCursor& root, TimelineBuilder& builder) {
  for (const JsonCursor& phoneme : root.member("phonemes").elements(1, max_timeline_events)) {
    const std::string stress = phoneme.text_or("stress", "none");
    const auto* const at = std::find(stress_names.begin(), stress_names.end(), stress);
    if (at == stress_names.end())
      phoneme.fail(ErrorCode::out_of_range, "the stress must be none, primary or secondary");
    SpokenPhoneme sound{phoneme.member("time").number(0.0, most_timeline_ms),
                        printable(phoneme.member("ipa").text(most_symbol_bytes)),
                        static_cast<Stress>(at - stress_names.begin())};
    const double end = phoneme.member("end").number(0.0, most_timeline_ms);
    if (has_failed(root, builder)) return false;
    builder.stressed_sound(std::move(sound), end, phoneme.pointer());
  }
  return !has_failed(root, builder);
}

/// `are_placed`: in the file's text.
bool read_words(const JsonCursor& root, bool are_placed, TimelineBuilder& builder) {
  const auto words = root.optional_member("words");
  if (!words) return true;
  for (const JsonCursor& word : words->elements(0, max_timeline_events)) {
    const double time = word.member("time").number(0.0, most_timeline_ms);
    const std::string text = word.member("text").text(most_text_bytes);
    const auto first = are_placed ? word.member("first").integer(0, max_utterance_text_bytes) : 0;
    if (has_failed(root, builder)) return false;
    if (are_placed)
      builder.placed_word(time, text, static_cast<std::size_t>(first), word.pointer());
    else
      builder.word(time, text, word.pointer());
  }
  return !has_failed(root, builder);
}

bool read_sentences(const JsonCursor& root, TimelineBuilder& builder) {
  const auto sentences = root.optional_member("sentences");
  if (!sentences) return true;
  for (const JsonCursor& sentence : sentences->elements(0, max_timeline_events)) {
    const double time = sentence.member("time").number(0.0, most_timeline_ms);
    const auto first = sentence.member("first").integer(0, max_utterance_text_bytes);
    if (has_failed(root, builder)) return false;
    builder.placed_sentence(time, static_cast<std::size_t>(first), sentence.pointer());
  }
  return !has_failed(root, builder);
}

bool read_marks(const JsonCursor& root, TimelineBuilder& builder) {
  const auto marks = root.optional_member("marks");
  if (!marks) return true;
  for (const JsonCursor& mark : marks->elements(0, max_timeline_events)) {
    const double time = mark.member("time").number(0.0, most_timeline_ms);
    const std::string name = mark.member("name").text(most_text_bytes);
    if (has_failed(root, builder)) return false;
    builder.mark(time, name, mark.pointer());
  }
  return !has_failed(root, builder);
}

}  // namespace

void read_semblante(std::string_view file, TimelineBuilder& builder) {
  read_object(file, builder, [&](const JsonCursor& root) {
    if (!read_json_phonemes(root, builder)) return;
    // Places are those of the text: a file without it names its words alone.
    const auto whole = root.optional_member("text");
    if (whole) builder.whole_text(whole->text(max_utterance_text_bytes));
    if (!read_words(root, whole.has_value(), builder)) return;
    if (whole && !read_sentences(root, builder)) return;
    if (!read_marks(root, builder)) return;
    if (const auto duration = root.optional_member("duration")) {
      const double end = duration->number(0.0, most_timeline_ms);
      if (!root.failed()) builder.reach(end);
    }
  });
}

}  // namespace semblante

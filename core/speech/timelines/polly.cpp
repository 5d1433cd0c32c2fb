#include <string>

#include "core/speech/timelines/formats.h"
#include "core/speech/timelines/timeline_json.h"
#include "core/speech/timelines/viseme_symbols.h"

namespace semblante::visemes {
namespace {

constexpr VisemeSymbol polly_rows[] = {
    {"sil", ""}, {"p", "p"}, {"t", "t"}, {"S", "ʃ"}, {"T", "θ"}, {"f", "f"},
    {"k", "k"},  {"i", "i"}, {"r", "ɹ"}, {"s", "s"}, {"u", "u"}, {"@", "ə"},
    {"a", "a"},  {"e", "e"}, {"E", "ɛ"}, {"o", "o"}, {"O", "ɔ"}, {"l", "l"},  // English, in the tables of later years
    {"J", "j"},                                                               // palatal consonants: ɲ ʎ ɕ
    {"B", "v"},                                                               // β: the lips are nearly closed
};

}  // namespace

constinit const VisemeSymbols polly = {
    "polly",
    "Amazon Web Services, Amazon Polly Developer Guide, Phoneme and viseme tables for supported languages, and Speech "
    "marks (docs.aws.amazon.com/polly/latest/dg/ref-phoneme-tables-shell.html)",
    polly_rows};

}  // namespace semblante::visemes

namespace semblante {

void read_polly(std::string_view file, TimelineBuilder& builder) {
  each_value(file, builder, [&](const JsonCursor& mark) {
    mark.must_be_object();
    const double time = mark.member("time").number(0.0, most_timeline_ms);
    const std::string type = mark.member("type").text(most_symbol_bytes);
    const JsonCursor value = mark.member("value");
    const std::string text = value.text(most_text_bytes);
    if (mark.failed()) return;
    if (type == "viseme")
      builder.sound(text, time, {}, value.pointer());
    else if (type == "word")
      builder.word(time, text, value.pointer());
    else if (type == "sentence")
      builder.sentence(time, text, value.pointer());
    else if (type == "ssml")
      builder.mark(time, text, value.pointer());
    else
      builder.fail(ErrorCode::out_of_range, value.pointer(), "the type must be viseme, word, sentence or ssml");
  });
}

}  // namespace semblante

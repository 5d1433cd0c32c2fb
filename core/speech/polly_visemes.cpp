#include "core/speech/viseme_symbols.h"

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

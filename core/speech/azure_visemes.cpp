#include "core/speech/viseme_symbols.h"

namespace semblante::visemes {
namespace {

constexpr VisemeSymbol azure_rows[] = {
    {"0", ""},   {"1", "ʌ"},  {"2", "ɑ"},   {"3", "ɔ"},   {"4", "ɛ"},  {"5", "ɝ"},  {"6", "ɪ"},  {"7", "u"},
    {"8", "o"},  {"9", "aʊ"}, {"10", "ɔɪ"}, {"11", "aɪ"}, {"12", "h"}, {"13", "ɹ"}, {"14", "l"}, {"15", "s"},
    {"16", "ʃ"}, {"17", "ð"}, {"18", "f"},  {"19", "t"},  {"20", "k"}, {"21", "p"},
};

}  // namespace

constinit const VisemeSymbols azure = {
    "azure",
    "Microsoft, Azure AI Speech documentation, Get facial position with viseme, table \"Map phonemes to visemes\" "
    "(learn.microsoft.com/azure/ai-services/speech-service/how-to-speech-synthesis-viseme)",
    azure_rows};

}  // namespace semblante::visemes

#include "core/speech/timelines/viseme_symbols.h"

namespace semblante::visemes {
namespace {

constexpr VisemeSymbol oculus_rows[] = {
    {"sil", ""}, {"PP", "p"}, {"FF", "f"}, {"TH", "θ"}, {"DD", "t"}, {"kk", "k"}, {"CH", "ʃ"}, {"SS", "s"},
    {"nn", "n"}, {"RR", "ɹ"}, {"aa", "ɑ"}, {"E", "ɛ"},  {"I", "ɪ"},  {"O", "o"},  {"U", "u"},
};

}  // namespace

constinit const VisemeSymbols oculus = {
    "oculus",
    "Meta, Oculus Lipsync documentation, Viseme reference (developers.meta.com/horizon/documentation/unity/"
    "audio-ovrlipsync-viseme-reference); as HeadTTS writes them: its README, API reference "
    "(github.com/met4citizen/HeadTTS)",
    oculus_rows};

}  // namespace semblante::visemes

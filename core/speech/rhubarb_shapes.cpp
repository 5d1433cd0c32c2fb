#include "core/speech/viseme_symbols.h"

namespace semblante::visemes {
namespace {

constexpr VisemeSymbol rhubarb_rows[] = {
    {"A", "m"},  // closed
    {"B", "s"},  // slightly open, teeth together: most consonants, and "ee"
    {"C", "ɛ"},  // open
    {"D", "ɑ"},  // wide open
    {"E", "ɔ"},  // slightly rounded
    {"F", "u"},  // puckered
    {"G", "f"},  // upper teeth on the lower lip
    {"H", "l"},  // the tongue behind the upper teeth
    {"X", ""},   // at rest
};

}  // namespace

constinit const VisemeSymbols rhubarb = {
    "rhubarb", "D. S. Wolf, Rhubarb Lip Sync, README, Mouth shapes (github.com/DanielSWolf/rhubarb-lip-sync)",
    rhubarb_rows};

}  // namespace semblante::visemes

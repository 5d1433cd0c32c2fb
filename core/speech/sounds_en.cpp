#include "core/speech/sounds_tables.h"

namespace semblante::sounds {
namespace {

using enum SoundKind;

constexpr Sound rows[] = {
    // vowels: the place of each on the chart, between the vowels that MPEG-4 has
    {"i", i, i, 1.0F, 1.0F, vowel},
    {"ɪ", i, e, 0.7F, 0.9F, vowel},
    {"e", e, e, 1.0F, 0.9F, vowel},
    {"ɛ", e, a, 0.75F, 1.0F, vowel},
    {"æ", a, e, 0.55F, 1.0F, vowel},
    {"a", a, a, 1.0F, 0.95F, vowel},
    {"ɑ", a, a, 1.0F, 1.0F, vowel},
    {"ʌ", a, e, 0.7F, 0.7F, vowel},
    {"ɐ", a, e, 0.6F, 0.6F, vowel},
    {"ə", e, a, 0.6F, 0.5F, vowel},
    {"ɒ", o, a, 0.6F, 1.0F, round_vowel},
    {"ɔ", o, a, 0.75F, 1.0F, round_vowel},
    {"o", o, o, 1.0F, 1.0F, round_vowel},
    {"ʊ", u, o, 0.7F, 0.9F, round_vowel},
    {"u", u, u, 1.0F, 1.0F, round_vowel},
    {"ɜ", r, e, 0.6F, 0.9F, round_vowel},
    {"ɚ", r, e, 0.7F, 0.8F, round_vowel},
    {"ɝ", r, e, 0.6F, 0.9F, round_vowel},
    // consonants
    {"p", p_b_m, p_b_m, 1.0F, 1.0F, both_lips},
    {"b", p_b_m, p_b_m, 1.0F, 1.0F, both_lips},
    {"m", p_b_m, p_b_m, 1.0F, 1.0F, both_lips},
    {"f", f_v, f_v, 1.0F, 1.0F, lip_and_teeth},
    {"v", f_v, f_v, 1.0F, 1.0F, lip_and_teeth},
    {"θ", th, th, 1.0F, 1.0F, tongue_tip},
    {"ð", th, th, 1.0F, 0.9F, tongue_tip},
    {"t", t_d, t_d, 1.0F, 1.0F, tongue_tip},
    {"d", t_d, t_d, 1.0F, 1.0F, tongue_tip},
    {"ɾ", t_d, n_l, 0.5F, 0.8F, tongue_tip},
    {"n", n_l, n_l, 1.0F, 1.0F, tongue_tip},
    {"l", n_l, n_l, 1.0F, 1.0F, tongue_tip},
    {"ɫ", n_l, n_l, 1.0F, 1.0F, tongue_tip},
    {"s", s_z, s_z, 1.0F, 1.0F, hiss},
    {"z", s_z, s_z, 1.0F, 1.0F, hiss},
    {"tʃ", ch_j_sh, ch_j_sh, 1.0F, 1.0F, round_consonant},
    {"dʒ", ch_j_sh, ch_j_sh, 1.0F, 1.0F, round_consonant},
    {"ʃ", ch_j_sh, ch_j_sh, 1.0F, 1.0F, round_consonant},
    {"ʒ", ch_j_sh, ch_j_sh, 1.0F, 1.0F, round_consonant},
    {"ɹ", r, r, 1.0F, 1.0F, round_consonant},
    {"r", r, r, 1.0F, 1.0F, round_consonant},
    {"w", u, u, 1.0F, 1.0F, round_vowel},
    {"ʍ", u, u, 1.0F, 1.0F, round_vowel},
    {"j", i, i, 1.0F, 0.8F, vowel},
    {"k", k_g, k_g, 1.0F, 1.0F, tongue_back},
    {"ɡ", k_g, k_g, 1.0F, 1.0F, tongue_back},
    {"g", k_g, k_g, 1.0F, 1.0F, tongue_back},
    {"ŋ", k_g, k_g, 1.0F, 1.0F, tongue_back},
    {"x", k_g, k_g, 1.0F, 1.0F, tongue_back},
    {"h", sil, sil, 1.0F, 1.0F, throat},
    {"ʔ", sil, sil, 1.0F, 1.0F, throat},
};

}  // namespace

constinit const SoundTable english = {
    "en",
    "P. Ladefoged, American English, in: Handbook of the International Phonetic Association, 1999, pp. 41-44; visemes: "
    "ISO/IEC 14496-2, table of visemes",
    rows};

}  // namespace semblante::sounds

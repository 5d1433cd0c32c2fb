#include "core/speech/sounds_tables.h"

namespace semblante::sounds {
namespace {

using enum SoundKind;

constexpr Sound portuguese_rows[] = {
    // vowels; nasal ones have the mouth of the oral ones. Precomposed letters of espeak-ng are rows of their own.
    {"i", i, i, 1.0F, 1.0F, vowel},
    {"ĩ", i, i, 1.0F, 1.0F, vowel},
    {"ɪ", i, e, 0.75F, 0.8F, vowel},
    {"y", i, i, 1.0F, 0.8F, vowel},
    {"e", e, i, 0.8F, 1.0F, vowel},
    {"ẽ", e, i, 0.8F, 0.9F, vowel},
    {"ɛ", e, a, 0.65F, 1.0F, vowel},
    {"æ", a, e, 0.6F, 0.8F, vowel},
    {"a", a, a, 1.0F, 1.0F, vowel},
    {"ã", a, e, 0.75F, 0.85F, vowel},
    {"ɐ", a, e, 0.7F, 0.8F, vowel},
    {"ə", e, a, 0.5F, 0.5F, vowel},
    {"ɔ", o, a, 0.6F, 1.0F, round_vowel},
    {"o", o, o, 1.0F, 0.9F, round_vowel},
    {"õ", o, o, 1.0F, 0.85F, round_vowel},
    {"ʊ", u, o, 0.75F, 0.85F, round_vowel},
    {"u", u, u, 1.0F, 1.0F, round_vowel},
    {"ũ", u, u, 1.0F, 1.0F, round_vowel},
    // consonants
    {"p", p_b_m, p_b_m, 1.0F, 1.0F, both_lips},
    {"b", p_b_m, p_b_m, 1.0F, 1.0F, both_lips},
    {"m", p_b_m, p_b_m, 1.0F, 1.0F, both_lips},
    {"f", f_v, f_v, 1.0F, 1.0F, lip_and_teeth},
    {"v", f_v, f_v, 1.0F, 1.0F, lip_and_teeth},
    {"t", t_d, t_d, 1.0F, 1.0F, tongue_tip},
    {"d", t_d, t_d, 1.0F, 1.0F, tongue_tip},
    {"ɾ", t_d, n_l, 0.5F, 0.8F, tongue_tip},
    {"n", n_l, n_l, 1.0F, 1.0F, tongue_tip},
    {"ɲ", n_l, i, 0.6F, 1.0F, tongue_tip},
    {"l", n_l, n_l, 1.0F, 1.0F, tongue_tip},
    {"ʎ", n_l, i, 0.6F, 1.0F, tongue_tip},
    {"s", s_z, s_z, 1.0F, 1.0F, hiss},
    {"z", s_z, s_z, 1.0F, 1.0F, hiss},
    {"tʃ", ch_j_sh, ch_j_sh, 1.0F, 1.0F, round_consonant},
    {"dʒ", ch_j_sh, ch_j_sh, 1.0F, 1.0F, round_consonant},
    {"ʃ", ch_j_sh, ch_j_sh, 1.0F, 1.0F, round_consonant},
    {"ʒ", ch_j_sh, ch_j_sh, 1.0F, 1.0F, round_consonant},
    {"ɹ", r, r, 1.0F, 1.0F, round_consonant},
    {"w", u, u, 1.0F, 0.95F, round_vowel},
    {"j", i, i, 1.0F, 0.8F, vowel},
    {"k", k_g, k_g, 1.0F, 1.0F, tongue_back},
    {"ɡ", k_g, k_g, 1.0F, 1.0F, tongue_back},
    {"g", k_g, k_g, 1.0F, 1.0F, tongue_back},
    {"ŋ", k_g, k_g, 1.0F, 1.0F, tongue_back},
    // the strong r is made at the back of the mouth or in the throat
    {"r", k_g, k_g, 1.0F, 0.8F, tongue_back},
    {"x", k_g, k_g, 1.0F, 1.0F, tongue_back},
    {"χ", k_g, k_g, 1.0F, 1.0F, tongue_back},
    {"ʁ", k_g, k_g, 1.0F, 1.0F, tongue_back},
    {"ɣ", k_g, k_g, 1.0F, 1.0F, tongue_back},
    {"h", sil, sil, 1.0F, 1.0F, throat},
    {"ɦ", sil, sil, 1.0F, 1.0F, throat},
    {"ʔ", sil, sil, 1.0F, 1.0F, throat},
};

}  // namespace

constinit const SoundTable portuguese = {
    "pt",
    "P. A. Barbosa and E. C. Albano, Brazilian Portuguese, Journal of the International Phonetic Association 34(2), "
    "2004, pp. 227-232; visemes: J. M. De Martino, L. P. Magalhães and F. Violaro, Facial animation based on "
    "context-dependent visemes, Computers & Graphics 30(6), 2006, pp. 971-980, in those of ISO/IEC 14496-2",
    portuguese_rows};

}  // namespace semblante::sounds

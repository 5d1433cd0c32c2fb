#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace semblante {

/// What a sound does with mouth and jaw, as coarticulation needs it: who gives way to whom.
enum class SoundKind : std::uint8_t {
  silence,
  vowel,
  round_vowel,
  both_lips,        ///< p b m: closes completely
  lip_and_teeth,    ///< f v
  tongue_tip,       ///< t d n l: the lips are free
  hiss,             ///< s z: the teeth are nearly closed
  round_consonant,  ///< ʃ ʒ ɹ: lips forward
  tongue_back,      ///< k ɡ ŋ: lips and jaw are free
  throat            ///< h ʔ: the mouth is that of its neighbours
};

/// A sound of IPA as a mixture of two visemes of MPEG-4: `share` of the first, the rest of the other; `open` times
/// their displacements.
struct Sound {
  std::string_view ipa;
  std::uint8_t viseme;
  std::uint8_t other;
  float share;
  float open;
  SoundKind kind;
};

struct SoundTable {
  std::string_view language;  ///< BCP 47, the primary subtag
  std::string_view source;    ///< where its symbols and their articulation are described
  std::span<const Sound> sounds;
};

std::span<const SoundTable> sound_tables();
/// The table of "pt-BR" or "en"; for a language without one that of the chart of IPA, by place of articulation and
/// rounding.
const SoundTable& sound_table(std::string_view language);
bool has_sound_table(std::string_view language);

/// How well a language is said.
enum class LanguageQuality : std::uint8_t {
  measured,  ///< a table of its own, and measured on heads against the sound
  table,     ///< a relative of one of these, read by its table
  english    ///< read by the chart of IPA; clients know it by this name, since English was read then
};
inline constexpr std::array<std::string_view, 3> language_quality_names = {"measured", "table", "english"};
LanguageQuality quality_of(std::string_view language);

/// The sounds of one symbol, in order: one, or several of a diphthong or a syllable ("aɪ", "əl"). Marks of length,
/// stress, nasality and syllables are skipped; what the table does not have is read by the chart of IPA; a symbol of
/// unknown letters alone is a neutral vowel.
std::vector<Sound> sounds_of(const SoundTable& table, std::string_view symbol);

namespace sounds {
enum Viseme : std::uint8_t { sil, p_b_m, f_v, th, t_d, k_g, ch_j_sh, s_z, n_l, r, a, e, i, o, u };
}

}  // namespace semblante

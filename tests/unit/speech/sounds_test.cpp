// Symbols of voices become sounds by the table of a language.
#include "core/speech/sounds.h"

#include <gtest/gtest.h>

#include "core/types/printable.h"

namespace semblante {
namespace {

using namespace sounds;

std::vector<int> visemes(std::string_view language, std::string_view symbol) {
  std::vector<int> found;
  for (const Sound& sound : sounds_of(sound_table(language), symbol)) found.push_back(sound.viseme);
  return found;
}

TEST(Sounds, DiphthongsMove_AffricatesAreOneSound) {
  EXPECT_EQ(visemes("en-US", "aɪ"), (std::vector<int>{a, i}));
  EXPECT_EQ(visemes("en", "aɪɚ"), (std::vector<int>{a, i, r}));
  EXPECT_EQ(visemes("en", "əl"), (std::vector<int>{e, n_l}));
  EXPECT_EQ(visemes("en", "tʃ"), (std::vector<int>{ch_j_sh}));
  EXPECT_EQ(visemes("pt-BR", "ɐ̃ʊ̃"), (std::vector<int>{a, u}));
  EXPECT_EQ(visemes("pt-BR", "ũ"), (std::vector<int>{u}));
  EXPECT_EQ(visemes("en", "uː"), (std::vector<int>{u}));
}

TEST(Sounds, UnknownSymbols_AreANeutralVowel) {
  EXPECT_EQ(visemes("en", "ʘ"), (std::vector<int>{e}));
  EXPECT_EQ(visemes("en", "\xFF\xC3"), (std::vector<int>{e}));
  EXPECT_FALSE(has_sound_table("xx"));
  EXPECT_EQ(visemes("xx", "m"), (std::vector<int>{p_b_m}));
}

TEST(Sounds, OfOtherLanguages_AreReadByTheChart) {
  EXPECT_EQ(visemes("fr", "y"), (std::vector<int>{u})) << "rounded";
  EXPECT_EQ(visemes("de", "øː"), (std::vector<int>{o}));
  EXPECT_EQ(visemes("fr", "ɑ̃"), (std::vector<int>{a}));
  EXPECT_EQ(visemes("it", "r"), (std::vector<int>{t_d})) << "lips stay where they are";
  EXPECT_EQ(visemes("ja", "tɕ"), (std::vector<int>{ch_j_sh}));
  EXPECT_EQ(sounds_of(sound_table("es"), "β")[0].kind, SoundKind::lip_and_teeth) << "lips come near, and do not close";
  EXPECT_EQ(visemes("en", "œ"), (std::vector<int>{o})) << "of a borrowed word";
  // The symbols that espeak-ng 1.51 gives for texts in these languages.
  for (const char* symbol :
       {"ə-", "ɔ̃",  "ɛ̃", "ɥ", "ʁ", "ʎ", "ɲ", "ɣ", "ð", "ç", "x", "pf", "ts", "ʏ", "œ", "ø", "ɽ", "ɕ",
        "o̞",  "ɯᵝ", "ä", "ħ", "ʕ", "ʲ", "ɨ", "ʂ", "ɪ", "ʊ", "ɐ", "tː", "dʒ", "ɟ", "c", "q", "ɭ", "ʋ"})
    EXPECT_FALSE(sounds_of(sound_table("xx"), symbol).front().ipa.empty()) << symbol;
}

/// The symbols that espeak-ng 1.51 gives for texts with all sounds of the language.
TEST(Sounds, Tables_HaveEverySymbolOfTheirVoice) {
  const std::pair<const char*, std::vector<const char*>> voices[] = {
      {"pt-BR", {"a", "ɐ", "ɐ̃", "æ",  "e",  "ɛ", "ẽ", "eɪ", "i", "ĩ",  "ɪ", "o", "ɔ", "õ", "oʊ", "u",
                 "ũ", "ʊ", "y", "aɪ", "aʊ", "b", "d", "dʒ", "f", "ɡ",  "j", "k", "l", "ʎ", "m",  "n",
                 "ɲ", "ŋ", "p", "ɾ",  "r",  "ɹ", "s", "ʃ",  "t", "tʃ", "v", "w", "x", "z", "ʒ",  "h"}},
      {"en", {"æ",  "ɑː", "ɐ",  "ə",  "ɚ", "ɛ", "ɜː", "ɪ",  "iː", "i", "ɔː", "ʊ", "uː", "ʌ", "aɪ", "aʊ",
              "eɪ", "oʊ", "ɔɪ", "əl", "n̩", "b", "d",  "dʒ", "ð",  "f", "ɡ",  "h", "j",  "k", "l",  "m",
              "n",  "ŋ",  "p",  "ɹ",  "ɾ", "s", "ʃ",  "t",  "tʃ", "θ", "v",  "w", "z",  "ʒ", "ʔ"}}};
  for (const auto& [language, symbols] : voices) {
    for (const std::string_view symbol : symbols) {
      const auto found = sounds_of(sound_table(language), symbol);
      ASSERT_FALSE(found.empty());
      EXPECT_FALSE(found.front().ipa.empty()) << language << ": " << symbol;
    }
  }
  for (const SoundTable& table : sound_tables()) EXPECT_GT(table.source.size(), 40U);
}

}  // namespace
}  // namespace semblante

#include "core/speech/sounds.h"

#include <algorithm>
#include <array>

#include "core/speech/sounds_tables.h"
#include "core/types/letter_case.h"
#include "core/types/printable.h"

namespace semblante {
namespace {

const std::array<SoundTable, 2>& tables() {
  static const std::array<SoundTable, 2> all = {sounds::english, sounds::portuguese};
  return all;
}

/// Of tests/golden/speech.
constexpr std::array<std::string_view, 4> measured_languages = {"pt", "pt-BR", "en", "en-US"};

constexpr Sound neutral = {"", sounds::e, sounds::a, 0.6F, 0.5F, SoundKind::vowel};

const SoundTable* find_table(std::string_view language) {
  const std::string primary = lower_case(language.substr(0, language.find('-')));
  const auto at = std::find_if(tables().begin(), tables().end(),
                               [&](const SoundTable& table) { return table.language == primary; });
  return at == tables().end() ? nullptr : &*at;
}

/// The longest symbol of the table that the text begins with.
const Sound* longest_of(const SoundTable& table, std::string_view text) {
  const Sound* longest = nullptr;
  for (const Sound& sound : table.sounds)
    if (text.starts_with(sound.ipa) && (longest == nullptr || sound.ipa.size() > longest->ipa.size())) longest = &sound;
  return longest;
}

}  // namespace

std::span<const SoundTable> sound_tables() { return tables(); }

bool has_sound_table(std::string_view language) { return find_table(language) != nullptr; }

LanguageQuality quality_of(std::string_view language) {
  if (std::find(measured_languages.begin(), measured_languages.end(), language) != measured_languages.end())
    return LanguageQuality::measured;
  return has_sound_table(language) ? LanguageQuality::table : LanguageQuality::english;
}

const SoundTable& sound_table(std::string_view language) {
  const SoundTable* const table = find_table(language);
  return table != nullptr ? *table : sounds::ipa_chart;
}

std::vector<Sound> sounds_of(const SoundTable& table, std::string_view symbol) {
  std::vector<Sound> found;
  while (!symbol.empty()) {
    const Sound* longest = longest_of(table, symbol);
    // A sound of another language, as in a word that is borrowed.
    if (longest == nullptr) longest = longest_of(sounds::ipa_chart, symbol);
    if (longest != nullptr) found.push_back(*longest);
    symbol.remove_prefix(longest != nullptr ? longest->ipa.size() : utf8_step(symbol));
  }
  if (found.empty()) found.push_back(neutral);
  return found;
}

}  // namespace semblante

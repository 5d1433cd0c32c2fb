#pragma once

#include "core/speech/sounds.h"

namespace semblante::sounds {

extern constinit const SoundTable english;     ///< sounds_en.cpp
extern constinit const SoundTable portuguese;  ///< sounds_pt.cpp
extern constinit const SoundTable ipa_chart;   ///< sounds_ipa.cpp: of every other language

}  // namespace semblante::sounds

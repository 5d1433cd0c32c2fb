#pragma once

#include <string_view>

#include "core/speech/timelines/timeline_builder.h"

namespace semblante {

// Readers, a file for each format: see TimelineFormat.
void read_azure(std::string_view file, TimelineBuilder& builder);
void read_headtts(std::string_view file, TimelineBuilder& builder);
void read_phonemes(std::string_view file, TimelineBuilder& builder);
void read_polly(std::string_view file, TimelineBuilder& builder);
void read_rhubarb(std::string_view file, TimelineBuilder& builder);
void read_semblante(std::string_view file, TimelineBuilder& builder);

}  // namespace semblante

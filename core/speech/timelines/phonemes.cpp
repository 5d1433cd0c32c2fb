#include "core/speech/timelines/formats.h"
#include "core/speech/timelines/timeline_lines.h"

namespace semblante {

void read_phonemes(std::string_view file, TimelineBuilder& builder) { read_table(file, 3, builder); }

}  // namespace semblante

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/cpp/face_frame.h"

/// What streams carry, to train and to measure their coding on: frames with their times from the beginning.
namespace semblante::bench {

struct Trace {
  std::string name;
  std::vector<TimedFrame> frames;
  double weight = 1.0;  ///< of each frame in training
};

/// The samples joy, anger and fear of SEMBLANTE_SAMPLES_DIR (one sentence spoken three times by an animation engine,
/// 25 frames a second); empty without it.
std::vector<Trace> samples();

/// The example minute.json without its FAP cues: visemes, expressions, blinks, glances and head motion.
Trace talking_minute(const std::string& source_folder);

/// The same kind of talk made up from a seed: what training may see of it.
Trace made_up_talk(unsigned seed, double frames_per_second);

/// As a camera would have it: every FAP of lips, lids, brows and cheeks trembles by itself, times jitter.
Trace live_capture(unsigned seed);

/// All that training uses beside the samples.
std::vector<Trace> made_up_traces();

}  // namespace semblante::bench

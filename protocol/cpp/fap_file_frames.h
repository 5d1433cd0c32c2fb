#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/types/result.h"
#include "protocol/cpp/face_values.h"
#include "protocol/cpp/fap_file.h"

namespace semblante {

/// The value of a FAP that a frame's mask omits: zero or the value of the frame before (keep). Zero is the default,
/// because players of these files start every frame at zero, and some writers flag only nonzero FAPs; with keep their
/// faces would freeze.
enum class AbsentFap : std::uint8_t {
  zero,
  keep,  ///< its last value, as in the bitstream of an encoder
};

/// Motion in gaps of the frame numbers. Hold is the default, because writers omit repeated frames.
enum class FrameGap : std::uint8_t { hold, interpolate };

struct FapFileMeaning {
  AbsentFap absent = AbsentFap::zero;
  FrameGap gap = FrameGap::hold;
};

/// The frames of a file with their times. With `hold`, a copy of the frame before a gap is added one frame before the
/// end of the gap, so that players that interpolate between frames also hold. viseme_def, init_face and
/// expression_def have no effect. Errors: out_of_range beyond 24 hours.
Result<std::vector<TimedValues>> frames_of(const FapFile& file, const FapFileMeaning& meaning = {});

/// Interpolates between a and b, t in 0..1: FAPs 3 to 68 linearly, FAPs 1 and 2 if both have the same selects; else
/// FAPs 1 and 2 are a's.
FaceValues between(const FaceValues& a, const FaceValues& b, double t);

struct FapFileStyle {
  double rate = 0;           ///< frames per second, 0.001..1000; 0: derived from the times, see rate_of
  bool whole_values = true;  ///< rounded, because most readers of .fap files expect integers
  std::string name = "semblante";
};

/// The lowest whole rate, at most 1000, at which every time is the time of a frame within half a millisecond. 25 for a
/// single frame.
double rate_of(std::span<const TimedValues> frames);

/// A file of frames 0, 1, 2, ... without gaps and with the same mask in all frames, so that every AbsentFap gives the
/// same face: FAPs that no frame uses are absent, all others present. The first frame is number 0 at any time. Values
/// are interpolated linearly between the given frames, FAPs 1 and 2 only if their selects are equal (else held); of
/// several frames within one frame of the file the last is used. Errors: empty; too_large beyond `limits`.
Result<FapFile> fap_file_of(std::span<const TimedValues> frames, const FapFileStyle& style = {},
                            const FapFileLimits& limits = {});

}  // namespace semblante

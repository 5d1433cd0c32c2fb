#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/types/result.h"
#include "protocol/cpp/face_values.h"
#include "protocol/cpp/fap_file.h"

namespace semblante {

/// What a FAP means in a frame whose mask leaves it out. The players that read these files begin every frame at zero,
/// and some writers mark only what is not zero, so that their files would freeze if it meant "as before": zero is the
/// default.
enum class AbsentFap : std::uint8_t {
  zero,
  keep,  ///< its last value, as an encoder's bitstream means it
};

/// What the face does where frame numbers are left out: writers leave out what repeats, so hold is the default.
enum class FrameGap : std::uint8_t { hold, interpolate };

struct FapFileMeaning {
  AbsentFap absent = AbsentFap::zero;
  FrameGap gap = FrameGap::hold;
};

/// The faces of a file, in time. A gap that holds ends in a copy of the frame before it, one frame before the next, so
/// that who interpolates between frames (as players of streams do) holds too. viseme_def, init_face and expression_def
/// have no effect. Errors: out_of_range beyond 24 hours.
Result<std::vector<TimedValues>> frames_of(const FapFile& file, const FapFileMeaning& meaning = {});

/// The face t of the way (0..1) from a to b: FAPs 3 to 68 linearly, FAPs 1 and 2 where both have the same selects; else
/// they are a's.
FaceValues between(const FaceValues& a, const FaceValues& b, double t);

struct FapFileStyle {
  double rate = 0;           ///< frames a second, 0.001..1000; 0: told from the times, see rate_of
  bool whole_values = true;  ///< rounded, as most readers of .fap files want them
  std::string name = "semblante";
};

/// The lowest whole rate at which every time is that of a frame, to half a millisecond, at most 1000. 25 for one frame
/// alone.
double rate_of(std::span<const TimedValues> frames);

/// A file of frames 0, 1, 2, ... without gaps and with one mask throughout, so that every reading of absent FAPs gives
/// the same face: what no frame uses is absent, all else present. The first frame is 0 whatever its time. Between the
/// given frames values go linearly, and FAPs 1 and 2 where their selects stay (else they hold); of frames within one of
/// the file's the last counts. Errors: empty; too_large beyond `limits`.
Result<FapFile> fap_file_of(std::span<const TimedValues> frames, const FapFileStyle& style = {},
                            const FapFileLimits& limits = {});

}  // namespace semblante

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/types/result.h"
#include "protocol/cpp/face_values.h"
#include "protocol/package/packed_face.h"

namespace semblante {

/// A clip is refused beyond these: a performance of hours is no animation clip, and it is made in memory.
inline constexpr std::size_t max_clip_frames = 1'000'000;
inline constexpr std::uint32_t max_clip_time = 4 * 3600 * 1000;  ///< ms; beyond, float seconds do not tell ms apart
inline constexpr std::size_t max_clip_keys = 4'000'000;          ///< of all joints together, after thinning out

struct ClipOptions {
  std::string name = "performance";     ///< of the animation
  int influences = 8;                   ///< joints a vertex has at most: 4, 8, 12 or 16
  std::optional<float> viseme_share{};  ///< of Eq. 5, as a stream's header may have it; empty: that of rig.json
};

/// What making a clip cost and what it left out; the same stands in asset.extras of the file.
struct ClipFigures {
  std::size_t joints = 0;
  std::size_t channels = 0;
  std::size_t keys = 0;             ///< that the channels hold
  std::size_t keys_unthinned = 0;   ///< what they would hold with one a frame
  double quantum = 0.0;             ///< of positions in mesh.drc, model units: keys are left out within half of it
  std::size_t measured_frames = 0;  ///< all, or of each run of as many the one that moves most
  /// Greatest distance of a vertex from where the kernel puts it, FAP 47 left aside, model units: with all influences
  /// written, and as readers see it that take four.
  double error = 0.0;
  double error_first_four = 0.0;
  double error_tongue_roll = 0.0;  ///< what leaving FAP 47 out makes on top of it
};

struct Clip {
  std::vector<std::uint8_t> glb;
  ClipFigures figures;
  std::vector<std::string> warnings;  ///< in words: what the clip cannot show
};

/// Frames on a face as a glTF 2.0 binary that any viewer or engine plays: a plain mesh with its materials and images, a
/// skin whose joints are the feature points, eyes, pupils and head, and one animation with linear keys at the frames'
/// own times, from 0 on. Axes and unit are the package's. protocol/package/README.md says what is exact.
///
/// Of frames at one time the last counts. Errors: `empty` without frames, `too_large` over a limit above,
/// `invalid_argument` for options, `not_finite` and `out_of_range` (times that fall) with the pointer of the frame, and
/// those of open_package.
Result<Clip> make_clip(const FaceParts& parts, std::span<const TimedValues> frames, const ClipOptions& options = {});

/// The same file without an animation: the neutral face with its skin, for engines that bring their own.
Result<Clip> make_skinned_face(const FaceParts& parts, const ClipOptions& options = {});

}  // namespace semblante

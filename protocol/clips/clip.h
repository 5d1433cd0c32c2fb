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

/// Limits of a clip, which is made in memory.
inline constexpr std::size_t max_clip_frames = 1'000'000;
inline constexpr std::uint32_t max_clip_time = 4 * 3600 * 1000;  ///< ms; the limit of float seconds with ms resolution
inline constexpr std::size_t max_clip_keys = 4'000'000;          ///< of all joints together, after thinning

struct ClipOptions {
  std::string name = "performance";     ///< of the animation
  int influences = 8;                   ///< maximum number of joints of a vertex: 4, 8, 12 or 16
  std::optional<float> viseme_share{};  ///< of Eq. 5, as a stream's header may have it; empty: that of rig.json
};

/// Size and errors of a clip; also written to asset.extras of the file.
struct ClipFigures {
  std::size_t joints = 0;
  std::size_t channels = 0;
  std::size_t keys = 0;             ///< in the channels
  std::size_t keys_unthinned = 0;   ///< with one key per frame
  double quantum = 0.0;             ///< of positions in mesh.drc, model units: keys are omitted within half of it
  std::size_t measured_frames = 0;  ///< all, or from each run of equal length the one with the most motion
  /// Greatest distance of a vertex from the kernel's result, without FAP 47, model units: with all influences, and for
  /// readers that use four.
  double error = 0.0;
  double error_first_four = 0.0;
  double error_tongue_roll = 0.0;  ///< additional error because FAP 47 is omitted
};

struct Clip {
  std::vector<std::uint8_t> glb;
  ClipFigures figures;
  std::vector<std::string> warnings;  ///< as text: the motions that the clip cannot represent
};

/// Frames on a face as a glTF 2.0 binary for any viewer or engine: a plain mesh with its materials and images, a skin
/// whose joints are the feature points, eyes, pupils and head, and one animation with linear keys at the frames' own
/// times, from 0 on. Axes and unit are the package's. protocol/package/README.md states what is exact.
///
/// Of several frames at one time the last is used. Errors: `empty` without frames, `too_large` over a limit above,
/// `invalid_argument` for options, `not_finite` and `out_of_range` (decreasing times) with the pointer of the frame,
/// and those of open_package.
Result<Clip> make_clip(const FaceParts& parts, std::span<const TimedValues> frames, const ClipOptions& options = {});

/// The same file without an animation: the neutral face with its skin, for engines with their own animation.
Result<Clip> make_skinned_face(const FaceParts& parts, const ClipOptions& options = {});

}  // namespace semblante

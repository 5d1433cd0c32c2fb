/* Smooth interpolation between poses, for displays faster than the frames, where the corners of linear interpolation
 * are visible. The same rules as in semblante_kernel.h. */
#ifndef SEMBLANTE_EASE_H
#define SEMBLANTE_EASE_H

#include "core/kernel/semblante_kernel.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Interpolates between `from` and `to`, 0 <= t <= 1 (clamped), on a curve through before, from, to, after whose
 * velocity is continuous from one pair to the next. All are poses of one model; spans[0], [1], [2] are the times
 * between them (any unit, finite; the middle one must be positive).
 *
 * Each component is a cubic Hermite curve whose end slopes are the weighted harmonic means of the adjacent slopes, 0 if
 * these have different signs (Fritsch and Butland 1984): it never leaves the range between `from` and `to`. Rotations:
 * the same for the components of the quaternions, with signs chosen for the shorter arc, then normalized.
 * A span of 0 means that this pose is absent: the curve begins, or ends, with zero velocity. `out` may be any pose. */
void semblante_ease(const semblante_pose* before, const semblante_pose* from, const semblante_pose* to,
                    const semblante_pose* after, const float spans[3], float t, semblante_pose* out);

#ifdef __cplusplus
}
#endif

#endif

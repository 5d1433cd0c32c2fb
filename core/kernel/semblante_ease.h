/* Between poses without corners: for displays that are faster than the frames, where linear motion would show its
 * kinks. The same rules as semblante_kernel.h. */
#ifndef SEMBLANTE_EASE_H
#define SEMBLANTE_EASE_H

#include "core/kernel/semblante_kernel.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The pose t of the way from `from` to `to`, 0 <= t <= 1 (clamped), on a curve through before, from, to, after whose
 * velocity is continuous from one pair to the next. All are poses of one model, at times with the spans[0], [1], [2]
 * between them (any unit, finite; the middle one must be positive).
 *
 * Each component is a cubic of Hermite's form whose end slopes are the weighted harmonic means of the slopes on both
 * sides, 0 where these have different signs (Fritsch and Butland 1984): it never leaves the range between `from` and
 * `to`. Rotations: the same of their quaternions' components, taken on the nearer side each, then made unit length.
 * A span of 0 (no such pose): the curve begins, or ends, at rest. `out` may be any of the four. */
void semblante_ease(const semblante_pose* before, const semblante_pose* from, const semblante_pose* to,
                    const semblante_pose* after, const float spans[3], float t, semblante_pose* out);

#ifdef __cplusplus
}
#endif

#endif

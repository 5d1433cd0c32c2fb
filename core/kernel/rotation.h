/* Internal: rotations about the axes of the face, as unit quaternions x, y, z, w. */
#ifndef SEMBLANTE_KERNEL_ROTATION_H
#define SEMBLANTE_KERNEL_ROTATION_H

#define SEMBLANTE_AU_RADIANS 1e-5F

/* Rotates after q about one axis (0 x, 1 y, 2 z) by `value` AU (1e-5 rad): q = axis_turn * q. */
void semblante_turn_after(float q[4], int axis, float value);

#endif

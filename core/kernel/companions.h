/* Internal: feature points that follow others (semblante_companion). */
#ifndef SEMBLANTE_KERNEL_COMPANIONS_H
#define SEMBLANTE_KERNEL_COMPANIONS_H

#include "core/kernel/semblante_kernel.h"

/* Moves the companions. `set`: 84 by 3, the displacements by FAPs 1 and 2 alone; `own`: 84, bit i is set where a FAP of
 * the point itself moves it along axis i; `fp`: 84 by 3, on input the displacements by all FAPs, on output with the
 * companions. */
void semblante_move_companions(const semblante_rig* rig, const float* set, const uint8_t* own, float* fp);

#endif

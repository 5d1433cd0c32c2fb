/* The header is C: this file only has to compile, and the test calls it to know it was linked. */
#include "core/kernel/semblante_kernel.h"

unsigned semblante_frame_bytes_in_c(void);
unsigned semblante_frame_bytes_in_c(void) { return (unsigned)sizeof(semblante_frame); }

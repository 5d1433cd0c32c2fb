/* Registers of four floats: SSE2, NEON and WebAssembly. */
#define SEMBLANTE_LANES 4
#define SEMBLANTE_GROUP 8U
#define SEMBLANTE_DEFORM_GROUPS semblante_deform_groups_plain
#include "core/kernel/deform_groups_body.h"

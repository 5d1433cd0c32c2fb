/* Registers of eight floats; compiled with -mavx2, so only the kernel's own headers may be included. */
#define SEMBLANTE_LANES 8
#define SEMBLANTE_GROUP 8U
#define SEMBLANTE_DEFORM_GROUPS semblante_deform_groups_avx2
#include "core/kernel/deform_groups_body.h"

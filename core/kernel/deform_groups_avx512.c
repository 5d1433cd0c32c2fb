/* Registers of sixteen floats; compiled with -mavx512f, so only the kernel's own headers may be included. */
#define SEMBLANTE_LANES 16
#define SEMBLANTE_GROUP 16U
#define SEMBLANTE_DEFORM_GROUPS semblante_deform_groups_avx512
#include "core/kernel/deform_groups_body.h"

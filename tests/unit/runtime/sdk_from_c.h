#ifndef SEMBLANTE_TESTS_SDK_FROM_C_H
#define SEMBLANTE_TESTS_SDK_FROM_C_H

#include "clients/runtime/semblante.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Makes a head, opens its jaw by 100 FAP units and writes the vertices; all of it in C. */
semblante_result open_jaw_from_c(const semblante_package* package, float* positions, size_t capacity);

#ifdef __cplusplus
}
#endif

#endif

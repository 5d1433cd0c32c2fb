#pragma once

#include "core/types/result.h"

namespace semblante::render {

/// Compiles and links a program in the current context. Errors: internal, with the driver's message.
Result<unsigned> link_program(const char* vertex_source, const char* fragment_source);

}  // namespace semblante::render

#include "core/types/result.h"

namespace semblante {

Error::Error(ErrorCode kind, const char* place, const char* words) : code(kind), where(place), message(words) {}

}  // namespace semblante

#include "server/settings/text.h"

#include <string>

#include "core/types/printable.h"

namespace semblante::settings {

Status check_text(std::string_view text, std::size_t max_bytes) {
  if (is_blank(text)) return Error{ErrorCode::empty, "", "it must not be empty"};
  if (text.size() > max_bytes)
    return Error{ErrorCode::too_large, "", "it has more than " + std::to_string(max_bytes) + " bytes"};
  if (has_controls(text)) return Error{ErrorCode::malformed, "", "it holds a control character"};
  return Unit{};
}

}  // namespace semblante::settings

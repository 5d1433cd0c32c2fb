#include "server/settings/text.h"

#include <algorithm>
#include <string>

namespace semblante::settings {

Status check_text(std::string_view text, std::size_t max_bytes) {
  if (text.find_first_not_of(' ') == std::string_view::npos) return Error{ErrorCode::empty, "", "it must not be empty"};
  if (text.size() > max_bytes)
    return Error{ErrorCode::too_large, "", "it has more than " + std::to_string(max_bytes) + " bytes"};
  if (std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }))
    return Error{ErrorCode::malformed, "", "it holds a control character"};
  return Unit{};
}

}  // namespace semblante::settings

#include "core/import/image_type.h"

#include "core/import/text.h"

namespace semblante::import {

std::string_view image_type(std::span<const std::uint8_t> bytes) {
  const std::string_view text = as_text(bytes);
  if (text.starts_with("\x89PNG")) return "image/png";
  if (text.starts_with("\xFF\xD8\xFF")) return "image/jpeg";
  if (text.starts_with("RIFF") && text.substr(0, 12).ends_with("WEBP")) return "image/webp";
  if (text.starts_with("\xABKTX 20\xBB\r\n\x1A\n")) return "image/ktx2";
  return {};
}

}  // namespace semblante::import

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/types/result.h"

namespace semblante::http {

/// One part of a multipart/form-data body. The content points into the body that was parsed.
struct FormPart {
  std::string name;
  std::string file_name;  ///< empty for a plain field
  std::string content_type;
  std::string_view content;
};

/// Parses RFC 7578 from untrusted bytes. At most `max_parts` parts; errors name the missing element.
Result<std::vector<FormPart>> parse_multipart(std::string_view body, std::string_view boundary,
                                              std::size_t max_parts = 16);

}  // namespace semblante::http

#include "protocol/cpp/json_cursor.h"

namespace semblante {

Result<nlohmann::json> parse_json_object(std::string_view text, std::size_t max_bytes) {
  if (text.size() > max_bytes) {
    return Error{ErrorCode::too_large, "", "a JSON text may have " + std::to_string(max_bytes) + " bytes"};
  }
  try {
    nlohmann::json root = nlohmann::json::parse(text.begin(), text.end());
    if (!root.is_object())
      return Error{ErrorCode::malformed, "", "must be an object, not " + std::string(root.type_name())};
    return root;
  } catch (const nlohmann::json::parse_error& error) {
    return Error{ErrorCode::malformed, "", "not JSON from byte " + std::to_string(error.byte)};
  } catch (const nlohmann::json::out_of_range&) {
    return Error{ErrorCode::not_finite, "", "a number too large to be one"};
  }
}

}  // namespace semblante

#pragma once

#include <string>
#include <string_view>

namespace semblante::http {

/// A random id of a request: 16 hexadecimal digits. Any thread.
std::string new_request_id();
/// Whether an id that another program has given can stand in a header, a document and a line of the log: 1 to 64
/// letters, digits, '.', '_' and '-'.
bool is_request_id(std::string_view id);

/// Header field of the id, in requests of proxies and in every answer.
inline constexpr std::string_view request_id_header = "X-Request-Id";

}  // namespace semblante::http

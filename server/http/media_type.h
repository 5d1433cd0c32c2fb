#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace semblante::http {

/// "text/html; charset=utf-8" -> "text/html", lower case, without parameters.
std::string essence(std::string_view media_type);

/// The value of a parameter of a media type or disposition: ("multipart/form-data; boundary=x", "boundary") -> "x";
/// quotes are removed. Empty when it is missing.
std::string parameter(std::string_view value, std::string_view name);

/// The file name in a Content-Disposition, in UTF-8. `filename*` (RFC 8187) has precedence: in forms it should not be
/// (RFC 7578, 4.2), but some libraries write it there for names beyond ASCII, with a substitute in `filename`.
std::string file_name_of(std::string_view disposition);

/// Whether an `Accept` value (may be empty: everything) takes this media type. Weights above zero are not ranked: each
/// resource has one representation.
bool accepts(std::string_view accept, std::string_view media_type);

/// By the file's extension; "application/octet-stream" for an unknown one.
std::string_view media_type_of_file(std::string_view file_name);

/// "a, b ,c" -> {"a", "b", "c"}.
std::vector<std::string> split_list(std::string_view value, char separator = ',');

}  // namespace semblante::http

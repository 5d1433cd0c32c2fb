#pragma once

#include <string>

namespace semblante {

/// Checks of options with the names that browsers send, and that requests are compared with letter by letter: empty, or
/// what is wrong. "*" is any.
std::string fault_of_origin(const std::string& text);  ///< "https://faces.example:8443", "null"
std::string fault_of_host(const std::string& text);    ///< "faces.example", "::1"

}  // namespace semblante

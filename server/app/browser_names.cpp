#include "server/app/browser_names.h"

#include <algorithm>
#include <string_view>

#include "server/http/address_range.h"

namespace semblante {
namespace {

bool consists_of(std::string_view text, std::string_view others, bool with_capitals) {
  return std::all_of(text.begin(), text.end(), [&](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || (with_capitals && c >= 'A' && c <= 'Z') ||
           others.find(c) != std::string_view::npos;
  });
}

/// Browsers leave out the port that a scheme has of itself.
bool has_port_of_scheme(std::string_view origin) {
  return (origin.starts_with("https://") && origin.ends_with(":443")) ||
         (origin.starts_with("http://") && origin.ends_with(":80"));
}

}  // namespace

std::string fault_of_origin(const std::string& text) {
  if (text == "*" || text == "null") return "";
  const auto scheme = text.find("://");
  const bool is_origin = scheme != std::string::npos && scheme > 0 &&
                         consists_of(std::string_view(text).substr(0, scheme), "+-.", false) &&
                         consists_of(std::string_view(text).substr(scheme + 3), "-._:[]", false);
  if (is_origin && !has_port_of_scheme(text)) return "";
  return text +
         " is no origin as browsers send it: scheme://host or scheme://host:port in small letters, without a path, "
         "* and the port that belongs to the scheme";
}

std::string fault_of_host(const std::string& text) {
  if (text == "*" || http::parse_address(text) || (!text.empty() && consists_of(text, "-._", true))) return "";
  return text + " is no name of a host alone, without scheme, port, path and *";
}

}  // namespace semblante

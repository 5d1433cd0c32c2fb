#include "protocol/http/url.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "core/types/letter_case.h"

namespace semblante::client {

Result<Url> parse_url(std::string_view text) {
  const std::string whole(text);
  const auto no_address = [&whole] {
    return Error{ErrorCode::invalid_argument, whole, "an address is http://HOST[:PORT][/PATH], or https://"};
  };
  Url url;
  if (const auto end = text.find("://"); end != std::string_view::npos) {
    const std::string scheme = lower_case(text.substr(0, end));
    if (scheme != "http" && scheme != "https") return no_address();
    url.secure = scheme == "https";
    if (url.secure) url.port = "443";
    text.remove_prefix(end + 3);
  }
  const std::size_t slash = text.find('/');
  std::string_view authority = text.substr(0, slash);
  if (slash != std::string_view::npos) {
    url.path = text.substr(slash);
    while (!url.path.empty() && url.path.back() == '/') {
      url.path.pop_back();
    }
  }
  const std::size_t bracket = authority.rfind(']');
  const std::size_t colon = authority.rfind(':');
  if (colon != std::string_view::npos && (bracket == std::string_view::npos || colon > bracket)) {
    url.port = authority.substr(colon + 1);
    authority = authority.substr(0, colon);
  }
  if (authority.size() > 2 && authority.front() == '[' && authority.back() == ']') {
    authority = authority.substr(1, authority.size() - 2);
  }
  url.host = authority;
  unsigned port = 0;
  const auto [end, problem] = std::from_chars(url.port.data(), url.port.data() + url.port.size(), port);
  if (problem != std::errc{} || end != url.port.data() + url.port.size() || port == 0 || port > 65535) {
    return Error{ErrorCode::invalid_argument, whole, "the port is a number from 1 to 65535"};
  }
  const auto is_bad = [](unsigned char c) { return c <= ' ' || c == '@' || c == '?' || c == '#' || c > '~'; };
  if (url.host.empty() || url.host.find_first_of("[]") != std::string::npos ||
      std::any_of(whole.begin(), whole.end(), is_bad)) {
    return no_address();
  }
  return url;
}

std::string Url::authority() const {
  const bool is_six = host.find(':') != std::string::npos;
  return (is_six ? "[" + host + "]" : host) + ":" + port;
}

std::string escape_segment(std::string_view segment) {
  static constexpr std::string_view digits = "0123456789ABCDEF";
  std::string escaped;
  for (const char c : segment) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || std::string_view("-._~").find(c) != std::string_view::npos) {
      escaped += c;
    } else {
      escaped += '%';
      escaped += digits[byte >> 4U];
      escaped += digits[byte & 15U];
    }
  }
  return escaped;
}

}  // namespace semblante::client

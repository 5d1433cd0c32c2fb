#include "server/http/request_id.h"

#include <algorithm>
#include <array>
#include <random>

namespace semblante::http {

std::string new_request_id() {
  // Only has to differ from others, so no secure source is needed for each.
  thread_local std::mt19937_64 source{(std::uint64_t{std::random_device{}()} << 32U) ^ std::random_device{}()};
  constexpr std::string_view digits = "0123456789abcdef";
  constexpr std::size_t length = 16;
  auto number = source();
  std::string id(length, '0');
  for (char& digit : id) {
    digit = digits[number & 0xFU];
    number >>= 4U;
  }
  return id;
}

bool is_request_id(std::string_view id) {
  constexpr std::size_t longest = 64;
  const auto is_allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
           c == '-';
  };
  return !id.empty() && id.size() <= longest && std::all_of(id.begin(), id.end(), is_allowed);
}

}  // namespace semblante::http

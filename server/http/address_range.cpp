#include "server/http/address_range.h"

#include <algorithm>
#include <charconv>

#include <arpa/inet.h>

namespace semblante::http {
namespace {

constexpr AddressBytes mapped_prefix = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF};
constexpr std::size_t mapped_bytes = 12;

bool is_mapped(const AddressBytes& address) {
  return std::equal(address.begin(), address.begin() + mapped_bytes, mapped_prefix.begin());
}

}  // namespace

std::optional<AddressBytes> parse_address(std::string_view text) {
  const std::string terminated(text);
  AddressBytes bytes = mapped_prefix;
  if (inet_pton(AF_INET, terminated.c_str(), bytes.data() + mapped_bytes) == 1) return bytes;
  if (inet_pton(AF_INET6, terminated.c_str(), bytes.data()) == 1) return bytes;
  return std::nullopt;
}

AddressBytes client_network(const AddressBytes& address) {
  if (is_mapped(address)) return address;
  AddressBytes network{};
  std::copy_n(address.begin(), network.size() / 2, network.begin());
  return network;
}

bool is_loopback(const AddressBytes& address) {
  if (is_mapped(address)) return address[mapped_bytes] == 127;
  constexpr AddressBytes one = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
  return address == one;
}

std::optional<AddressRange> AddressRange::parse(std::string_view text) {
  const auto slash = text.find('/');
  const auto address = parse_address(text.substr(0, slash));
  if (!address) return std::nullopt;
  AddressRange range;
  range.first_ = *address;
  if (slash == std::string_view::npos) return range;
  const auto digits = text.substr(slash + 1);
  const unsigned most = text.find(':') == std::string_view::npos ? 32 : 128;
  unsigned bits = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), bits);
  if (error != std::errc() || end != digits.data() + digits.size() || bits > most) return std::nullopt;
  range.bits_ = bits + (128 - most);
  return range;
}

bool AddressRange::contains(const AddressBytes& address) const {
  const auto whole = bits_ / 8;
  if (!std::equal(first_.begin(), first_.begin() + whole, address.begin())) return false;
  const auto rest = bits_ % 8;
  if (rest == 0) return true;
  const auto mask = 0xFFU << (8 - rest);
  return ((first_[whole] ^ address[whole]) & mask) == 0;
}

bool any_contains(std::span<const AddressRange> ranges, std::string_view address) {
  const auto bytes = parse_address(address);
  return bytes && std::any_of(ranges.begin(), ranges.end(), [&](const auto& range) { return range.contains(*bytes); });
}

}  // namespace semblante::http

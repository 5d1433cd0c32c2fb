#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace semblante::http {

/// An IP address as 16 bytes; IPv4 is mapped into IPv6 (::ffff:a.b.c.d), so that one address has one value.
using AddressBytes = std::array<std::uint8_t, 16>;
/// nullopt if the text is no IP address.
std::optional<AddressBytes> parse_address(std::string_view text);
/// What one client has: an IPv4 address, or the first 64 bits of an IPv6 address. Limits by address count these.
AddressBytes client_network(const AddressBytes& address);
/// True for 127.0.0.0/8 and ::1.
bool is_loopback(const AddressBytes& address);

/// "10.0.0.0/8", "::1", ...: all addresses with the same first bits.
class AddressRange {
 public:
  /// nullopt if the text is no address with an optional prefix length.
  static std::optional<AddressRange> parse(std::string_view text);
  [[nodiscard]] bool contains(const AddressBytes& address) const;

 private:
  AddressBytes first_{};
  unsigned bits_ = 128;
};

/// False for a text that is no address.
bool any_contains(std::span<const AddressRange> ranges, std::string_view address);

}  // namespace semblante::http

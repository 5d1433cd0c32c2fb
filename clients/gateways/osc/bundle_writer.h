#pragma once

#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <variant>
#include <vector>

namespace semblante::osc {

/// Writes messages into bundles of at most `max_bytes`, the size of a UDP packet; a message that does not fit starts a
/// new bundle. Their time tag is "immediately".
class BundleWriter {
 public:
  using Value = std::variant<std::int32_t, float, std::string_view>;

  explicit BundleWriter(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  /// Asserts that the message fits into a bundle, and that no text contains a zero.
  void add(std::string_view address, std::initializer_list<Value> values);
  /// All bundles since the last call, none of them empty.
  std::vector<std::vector<std::uint8_t>> finish();

 private:
  std::size_t max_bytes_;
  std::vector<std::vector<std::uint8_t>> bundles_;
};

}  // namespace semblante::osc

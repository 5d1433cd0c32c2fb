#pragma once

#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <variant>
#include <vector>

namespace semblante::osc {

/// Messages -> bundles, each of which fits a UDP packet of `max_bytes`; a further one is begun when one is full. Time
/// tag: at once.
class BundleWriter {
 public:
  using Value = std::variant<std::int32_t, float, std::string_view>;

  explicit BundleWriter(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  /// Asserts that the message alone fits, and that no text has a zero in it.
  void add(std::string_view address, std::initializer_list<Value> values);
  /// All bundles since the last call, none of them empty.
  std::vector<std::vector<std::uint8_t>> finish();

 private:
  std::size_t max_bytes_;
  std::vector<std::vector<std::uint8_t>> bundles_;
};

}  // namespace semblante::osc

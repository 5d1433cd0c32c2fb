#include "clients/gateways/osc/bundle_writer.h"

#include <bit>
#include <cassert>
#include <string>
#include <utility>

namespace semblante::osc {
namespace {

using Bytes = std::vector<std::uint8_t>;

void append_u32(Bytes& to, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) to.push_back(static_cast<std::uint8_t>(value >> shift));
}

void append_text(Bytes& to, std::string_view text) {
  assert(text.find('\0') == std::string_view::npos);
  to.insert(to.end(), text.begin(), text.end());
  to.resize(to.size() + 4 - text.size() % 4);
}

constexpr std::string_view begin("#bundle\0\0\0\0\0\0\0\0\1", 16);

}  // namespace

void BundleWriter::add(std::string_view address, std::initializer_list<Value> values) {
  constexpr std::string_view tags = "ifs";  // in the order of Value
  std::string types = ",";
  for (const Value& value : values) types += tags[value.index()];
  Bytes message;
  append_text(message, address);
  append_text(message, types);
  for (const Value& value : values) {
    if (const auto* whole = std::get_if<std::int32_t>(&value)) append_u32(message, static_cast<std::uint32_t>(*whole));
    if (const auto* real = std::get_if<float>(&value)) append_u32(message, std::bit_cast<std::uint32_t>(*real));
    if (const auto* text = std::get_if<std::string_view>(&value)) append_text(message, *text);
  }
  assert(begin.size() + 4 + message.size() <= max_bytes_);
  if (bundles_.empty() || bundles_.back().size() + 4 + message.size() > max_bytes_) {
    bundles_.emplace_back(begin.begin(), begin.end());
  }
  append_u32(bundles_.back(), static_cast<std::uint32_t>(message.size()));
  bundles_.back().insert(bundles_.back().end(), message.begin(), message.end());
}

std::vector<std::vector<std::uint8_t>> BundleWriter::finish() { return std::exchange(bundles_, {}); }

}  // namespace semblante::osc

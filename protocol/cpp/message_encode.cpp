#include <bit>
#include <cassert>

#include "protocol/cpp/byte_io.h"
#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/packed_codec.h"
#include "protocol/cpp/utf8.h"

namespace semblante {
namespace {

/// Writes the fields of one message in order.
class BinaryFieldWriter {
 public:
  explicit BinaryFieldWriter(std::vector<std::uint8_t>& to) : to_(to) {}

  void uint(const char*, std::uint64_t value, [[maybe_unused]] std::uint64_t max, Presence) {
    assert(value <= max);
    byte_io::append_varint(to_, value);
  }
  void real(const char*, double value, [[maybe_unused]] double min, [[maybe_unused]] double max, Presence) {
    assert(value >= min && value <= max);
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (unsigned i = 0; i < 8; ++i) to_.push_back(static_cast<std::uint8_t>(bits >> (8U * i)));
  }
  void boolean(const char*, bool value, Presence presence) {
    if (presence == Presence::appended && left_out(!value)) return;
    to_.push_back(value ? 1 : 0);
  }
  void text(const char*, const std::string& value, [[maybe_unused]] std::size_t max, Presence) {
    assert(value.size() <= max);
    assert(is_utf8({reinterpret_cast<const std::uint8_t*>(value.data()), value.size()}));
    byte_io::append_varint(to_, value.size());
    to_.insert(to_.end(), value.begin(), value.end());
  }
  void reals(const char* name, const std::vector<double>& values, [[maybe_unused]] std::size_t length, double min,
             double max, Presence presence) {
    assert(values.empty() || values.size() == length);
    byte_io::append_varint(to_, values.size());
    for (const double value : values) real(name, value, min, max, presence);
  }
  template <class E>
  void enumeration(const char*, E value, [[maybe_unused]] const EnumNames& names, Presence presence) {
    assert(static_cast<std::size_t>(value) < names.names.size());
    if (presence == Presence::appended && left_out(value == E{})) return;
    to_.push_back(static_cast<std::uint8_t>(value));
  }
  void bytes(const char*, const std::vector<std::uint8_t>& value, [[maybe_unused]] std::size_t max, Presence) {
    assert(value.size() <= max);
    byte_io::append_varint(to_, value.size());
    to_.insert(to_.end(), value.begin(), value.end());
  }
  template <class T>
  void optional(const char*, const std::optional<T>& value, Presence presence) {
    if (presence == Presence::appended && left_out(!value.has_value())) return;
    to_.push_back(value.has_value() ? 1 : 0);
    if (value.has_value()) visit_fields(*value, *this);
  }
  void optional_real(const char* name, const std::optional<double>& value, double min, double max) {
    if (left_out(!value.has_value())) return;
    to_.push_back(1);
    real(name, *value, min, max, Presence::required);
  }

 private:
  /// Trailing appended fields with default values are omitted, as writers of earlier versions omit them. The default
  /// of each is one zero byte.
  bool left_out(bool is_default) {
    if (is_default) return ++left_out_, true;
    to_.insert(to_.end(), left_out_, 0);
    left_out_ = 0;
    return false;
  }

  std::vector<std::uint8_t>& to_;
  std::size_t left_out_ = 0;  ///< number of appended fields omitted since the last written one
};

}  // namespace

void encode_message(const Message& message, std::vector<std::uint8_t>& to) {
  std::visit(
      [&]<class M>(const M& m) {
        if constexpr (is_packed<M>) {
          assert(false && "a PackedEncoder makes keyframes and frames");
        } else {
          to.push_back(MessageTraits<M>::type);
          BinaryFieldWriter writer(to);
          visit_fields(m, writer);
        }
      },
      message);
}

}  // namespace semblante

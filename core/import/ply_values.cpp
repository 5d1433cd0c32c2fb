#include "core/import/ply_values.h"

#include <charconv>
#include <cmath>
#include <limits>

namespace semblante::import {

PlyValues::PlyValues(std::span<const std::uint8_t> bytes, const PlyHeader& header)
    : is_text_(header.is_text),
      offset_(header.data_offset),
      data_(bytes.subspan(header.data_offset), header.order),
      lines_(as_text(bytes.subspan(header.data_offset))),
      header_lines_(header.line_count) {}

std::string PlyValues::where() const {
  return is_text_ ? "line " + std::to_string(header_lines_ + lines_.line())
                  : "byte " + std::to_string(offset_ + data_.position());
}

double PlyValues::next(PlyType type) {
  if (fault_) return 0.0;
  return is_text_ ? next_of_text() : next_of_bytes(type);
}

Result<std::size_t> PlyValues::list_size(const PlyProperty& list) {
  const double announced = next(*list.list_size);
  if (fault_) return *fault_;
  const std::size_t item = is_text_ ? 2 : size_of(list.type);
  const std::size_t most = (left() + 1) / item;
  if (announced < 0 || announced != std::floor(announced) || announced > static_cast<double>(most)) {
    return Error{ErrorCode::out_of_range, where(),
                 "list " + shown(list.name) + " has a number of items that is invalid or exceeds the data"};
  }
  return static_cast<std::size_t>(announced);
}

double PlyValues::next_of_bytes(PlyType type) {
  const std::string place = data_.left() < size_of(type) ? where() : std::string();
  double value = 0.0;
  switch (type) {
    case PlyType::i8:
      value = data_.read<std::int8_t>();
      break;
    case PlyType::u8:
      value = data_.read<std::uint8_t>();
      break;
    case PlyType::i16:
      value = data_.read<std::int16_t>();
      break;
    case PlyType::u16:
      value = data_.read<std::uint16_t>();
      break;
    case PlyType::i32:
      value = data_.read<std::int32_t>();
      break;
    case PlyType::u32:
      value = data_.read<std::uint32_t>();
      break;
    case PlyType::f32:
      value = data_.read<float>();
      break;
    case PlyType::f64:
      value = data_.read<double>();
      break;
  }
  if (!data_.ok())
    fault_ = Error{ErrorCode::truncated, place, "the data ends before the last element that the header declares"};
  return value;
}

double PlyValues::next_of_text() {
  std::string_view token = next_token(line_);
  while (token.empty()) {
    const auto line = lines_.next();
    if (!line) {
      fault_ = Error{ErrorCode::truncated, where(), "the data ends before the last element that the header declares"};
      return 0.0;
    }
    line_ = *line;
    token = next_token(line_);
  }
  double value = 0.0;
  if (token.size() > 1 && token.front() == '+' && token[1] != '-') token.remove_prefix(1);
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  if (error == std::errc::result_out_of_range) {
    // Underflow of a double gives zero; overflow is refused where the value is used.
    float small = 0.0F;
    value = parse_number(token, small) == NumberFault::none ? 0.0 : std::numeric_limits<double>::infinity();
  } else if (error != std::errc{} || end != token.data() + token.size()) {
    fault_ = Error{ErrorCode::malformed, where(), shown(token) + " is not a number"};
  }
  return value;
}

}  // namespace semblante::import

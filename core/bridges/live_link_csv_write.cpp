#include <array>
#include <cmath>
#include <utility>

#include "core/bridges/arkit_shapes.h"
#include "core/bridges/live_link_csv.h"
#include "core/types/decimal.h"

namespace semblante {
namespace {

constexpr int digits = 10;

/// The order of the file's columns: the stream's order except for two pairs.
std::array<std::size_t, arkit_count> columns_of_file() {
  std::array<std::size_t, arkit_count> order{};
  for (std::size_t s = 0; s < arkit_count; ++s) order[s] = s;
  std::swap(order[arkit::shape("jawLeft")], order[arkit::shape("jawRight")]);
  std::swap(order[arkit::shape("mouthLeft")], order[arkit::shape("mouthRight")]);
  return order;
}

std::string in_capitals(std::string_view name) {
  std::string result(name);
  result[0] = static_cast<char>(result[0] - 'a' + 'A');
  return result;
}

void append_padded(std::string& to, long long value, std::size_t width) {
  const std::string text = whole_text(value);
  to.append(text.size() < width ? width - text.size() : 0, '0').append(text);
}

void append_timecode(std::string& to, double seconds, double rate) {
  long long second = static_cast<long long>(std::floor(seconds));
  long long thousandths = std::llround((seconds - std::floor(seconds)) * rate * 1000.0);
  if (thousandths >= std::llround(rate * 1000.0)) thousandths = 0, ++second;
  append_padded(to, second / 3600 % 24, 2);
  append_padded(to += ':', second / 60 % 60, 2);
  append_padded(to += ':', second % 60, 2);
  append_padded(to += ':', thousandths / 1000, 2);
  append_padded(to += '.', thousandths % 1000, 3);
}

void append_value(std::string& to, float value) { to.append(",").append(fixed_text(value + 0.0F, digits)); }

}  // namespace

LiveLinkRow live_link_row_of(double seconds, const semblante_frame& face) {
  return {seconds, arkit_from_frame(face), head_turn_of(face), left_eye_turn_of(face), right_eye_turn_of(face)};
}

void append_live_link_header(std::string& to) {
  to += "Timecode,BlendShapeCount";
  for (const std::size_t s : columns_of_file()) to.append(",").append(in_capitals(arkit_name(s)));
  for (const std::string_view rotation : generated::arkit_rotations) to.append(",").append(in_capitals(rotation));
  to += '\n';
}

void append_live_link_row(std::string& to, const LiveLinkRow& row, double timecode_rate) {
  static const std::array<std::size_t, arkit_count> order = columns_of_file();
  append_timecode(to, row.seconds, timecode_rate);
  to.append(",").append(natural_text(arkit_count + generated::arkit_rotations.size()));
  for (const std::size_t s : order) append_value(to, row.coefficients[s]);
  for (const float angle : {row.head.yaw, row.head.pitch, row.head.roll, row.left_eye.yaw, row.left_eye.pitch, 0.0F,
                            row.right_eye.yaw, row.right_eye.pitch, 0.0F}) {
    append_value(to, angle);
  }
  to += '\n';
}

std::string write_live_link_csv(std::span<const LiveLinkRow> rows, double timecode_rate) {
  std::string text;
  append_live_link_header(text);
  for (const LiveLinkRow& row : rows) append_live_link_row(text, row, timecode_rate);
  return text;
}

}  // namespace semblante

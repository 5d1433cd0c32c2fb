#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/bridges/generated/arkit_tables.h"
#include "core/bridges/live_link_csv.h"
#include "core/types/decimal.h"
#include "core/types/warning_groups.h"

namespace semblante {
namespace {

constexpr double seconds_of_a_day = 86400.0;

Error at_line(std::size_t line, ErrorCode code, std::string message) {
  return {code, "line " + natural_text(line), std::move(message)};
}

/// Makes untrusted text safe for a message: shortened, without control characters.
std::string shown(std::string_view text) {
  std::string result(text.substr(0, 40));
  for (char& c : result) {
    if (c < ' ' || c > '~') c = '?';
  }
  return "'" + result + (text.size() > 40 ? "...'" : "'");
}

std::string_view next_line(std::string_view& rest) {
  const std::size_t end = std::min(rest.find('\n'), rest.size());
  std::string_view line = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  while (cells.size() <= max_live_link_columns) {
    const std::size_t comma = line.find(',');
    std::string_view cell = line.substr(0, comma);
    while (cell.starts_with(' ')) cell.remove_prefix(1);
    while (cell.ends_with(' ')) cell.remove_suffix(1);
    cells.push_back(cell);
    if (comma == std::string_view::npos) break;
    line.remove_prefix(comma + 1);
  }
  return cells;
}

/// A number, or a word for none that writers of floats use.
std::optional<float> read_real(std::string_view text) {
  const std::string_view magnitude = text.substr(text.starts_with('-') ? 1 : 0);
  for (const std::string_view word : {"nan", "inf", "NaN", "Inf", "NAN", "INF"}) {
    if (magnitude.starts_with(word)) return std::numeric_limits<float>::quiet_NaN();
  }
  return read_float(text);
}

/// HH:MM:SS:FF.sub -> seconds since midnight.
std::optional<double> seconds_of(std::string_view timecode, double rate) {
  std::array<double, 4> part{};
  for (std::size_t i = 0; i < part.size(); ++i) {
    const std::size_t end = i + 1 < part.size() ? timecode.find(':') : timecode.size();
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view text = timecode.substr(0, end);
    // Digits only, with a fraction only in the last field: no sign, exponent or "nan".
    if (text.empty() || text.size() > 12 ||
        text.find_first_not_of(i + 1 < part.size() ? "0123456789" : "0123456789.") != std::string_view::npos) {
      return std::nullopt;
    }
    const auto value = read_double(text);
    if (!value) return std::nullopt;
    part[i] = *value;
    timecode.remove_prefix(std::min(end + 1, timecode.size()));
  }
  if (part[0] >= 24.0 || part[1] >= 60.0 || part[2] >= 60.0 || part[3] >= std::max(rate, 1.0)) return std::nullopt;
  return part[0] * 3600.0 + part[1] * 60.0 + part[2] + part[3] / rate;
}

/// The field of a column: 0..51 a shape, 52..60 a rotation.
std::optional<std::size_t> field_of(std::string_view name) {
  if (const auto shape = find_arkit(name)) return shape;
  for (std::size_t r = 0; r < generated::arkit_rotations.size(); ++r) {
    std::string rotation(generated::arkit_rotations[r]);
    if (name == rotation) return arkit_count + r;
    rotation[0] = static_cast<char>(rotation[0] - 'a' + 'A');
    if (name == rotation) return arkit_count + r;
  }
  return std::nullopt;
}

void set_field(LiveLinkRow& row, std::size_t field, float value) {
  if (field < arkit_count) {
    row.coefficients[field] = value;
    return;
  }
  switch (field - arkit_count) {
    case 0:
      row.head.yaw = value;
      break;
    case 1:
      row.head.pitch = value;
      break;
    case 2:
      row.head.roll = value;
      break;
    case 3:
      row.left_eye.yaw = value;
      break;
    case 4:
      row.left_eye.pitch = value;
      break;
    case 6:
      row.right_eye.yaw = value;
      break;
    case 7:
      row.right_eye.pitch = value;
      break;
    default:
      break;  // the roll of an eye has no FAP
  }
}

struct Columns {
  std::size_t count = 0;
  std::size_t timecode = 0;
  std::optional<std::size_t> shape_count;
  std::vector<std::optional<std::size_t>> field;  ///< #columns
};

Result<Columns> read_header(std::string_view line, std::vector<std::string>& warnings) {
  Columns columns;
  const auto names = cells_of(line);
  if (names.size() > max_live_link_columns) {
    return at_line(1, ErrorCode::too_large, "more than " + natural_text(max_live_link_columns) + " columns");
  }
  columns.count = names.size();
  columns.field.resize(names.size());
  std::array<bool, arkit_count + generated::arkit_rotations.size()> seen{};
  bool has_timecode = false;
  for (std::size_t c = 0; c < names.size(); ++c) {
    if (names[c] == "Timecode" && !has_timecode) {
      columns.timecode = c;
      has_timecode = true;
    } else if (names[c] == "BlendShapeCount" && !columns.shape_count) {
      columns.shape_count = c;
    } else if (const auto field = field_of(names[c])) {
      if (seen[*field]) return at_line(1, ErrorCode::malformed, "column " + shown(names[c]) + " occurs twice");
      seen[*field] = true;
      columns.field[c] = field;
    } else if (!names[c].empty()) {
      warnings.push_back("column " + shown(names[c]) + " is not a shape of ARKit and is skipped");
    }
  }
  if (!has_timecode) return at_line(1, ErrorCode::malformed, "no column Timecode: not a CSV file of Live Link Face");
  const auto shapes = static_cast<std::size_t>(std::count(seen.begin(), seen.begin() + arkit_count, true));
  if (shapes == 0) return at_line(1, ErrorCode::malformed, "no column has the name of a shape of ARKit");
  if (shapes < arkit_count) {
    std::string missing;
    for (std::size_t s = 0; s < arkit_count; ++s) {
      if (!seen[s]) missing.append(missing.empty() ? "" : ", ").append(arkit_name(s));
    }
    warnings.push_back("no column for " + missing + ": the values are 0");
  }
  return columns;
}

Result<LiveLinkRow> read_row(std::string_view line, std::size_t number, const Columns& columns, double rate,
                             const LiveLinkRow& before) {
  const auto cells = cells_of(line);
  if (cells.size() <= columns.timecode)
    return at_line(number, ErrorCode::truncated, "the row ends before its timecode");
  const auto seconds = seconds_of(cells[columns.timecode], rate);
  if (!seconds) {
    return at_line(number, ErrorCode::malformed,
                   shown(cells[columns.timecode]) + " is not a timecode HH:MM:SS:FF.sub with FF below " +
                       whole_text(std::lround(rate)));
  }
  if (columns.shape_count && *columns.shape_count < cells.size() && cells[*columns.shape_count] == "0") {
    LiveLinkRow same = before;
    same.seconds = *seconds;
    return same;
  }
  if (cells.size() != columns.count) {
    return at_line(
        number, cells.size() < columns.count ? ErrorCode::truncated : ErrorCode::malformed,
        "the row has " + natural_text(cells.size()) + " values for " + natural_text(columns.count) + " columns");
  }
  LiveLinkRow row;
  row.seconds = *seconds;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (!columns.field[c]) continue;
    const auto value = read_real(cells[c]);
    if (!value) {
      return at_line(number, ErrorCode::malformed,
                     "column " + natural_text(c + 1) + ": " + shown(cells[c]) + " is not a number");
    }
    if (!std::isfinite(*value) || std::abs(*value) > 1e6F) {
      return at_line(number, ErrorCode::not_finite, "column " + natural_text(c + 1) + " is not a finite number");
    }
    set_field(row, *columns.field[c], *value);
  }
  return row;
}

}  // namespace

Result<LiveLinkTake> read_live_link_csv(std::string_view text, double timecode_rate) {
  if (text.size() > max_live_link_bytes) {
    return Error{ErrorCode::too_large, "", "the file has more than " + natural_text(max_live_link_bytes) + " bytes"};
  }
  if (!(timecode_rate >= 1.0 && timecode_rate <= 1000.0)) {
    return Error{ErrorCode::invalid_argument, "", "the timecode rate must be 1 to 1000 frames per second"};
  }
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  LiveLinkTake take;
  const auto columns = read_header(next_line(text), take.warnings);
  if (!columns) return columns.error();
  take.warnings = grouped_warnings(take.warnings);  // an extended rig has hundreds of columns of its own
  double first = 0.0;
  double last = 0.0;
  double days = 0.0;
  for (std::size_t number = 2; !text.empty(); ++number) {
    const std::string_view line = next_line(text);
    if (line.empty()) continue;
    if (take.rows.size() == max_live_link_rows) {
      return at_line(number, ErrorCode::too_large, "more than " + natural_text(max_live_link_rows) + " rows");
    }
    auto row = read_row(line, number, *columns, timecode_rate, take.rows.empty() ? LiveLinkRow{} : take.rows.back());
    if (!row) return row.error();
    double now = row->seconds + days;
    if (!take.rows.empty() && now < last - seconds_of_a_day / 2.0) {  // past midnight
      days += seconds_of_a_day;
      now += seconds_of_a_day;
    }
    if (take.rows.empty()) first = now;
    if (!take.rows.empty() && now < last)
      return at_line(number, ErrorCode::out_of_range, "the timecode is before that of the previous row");
    last = now;
    row->seconds = now - first;
    take.rows.push_back(*std::move(row));
  }
  if (take.rows.empty()) return Error{ErrorCode::empty, "", "the file has no rows"};
  return take;
}

}  // namespace semblante

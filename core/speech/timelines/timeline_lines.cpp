#include "core/speech/timelines/timeline_lines.h"

#include <cmath>
#include <optional>
#include <vector>

#include "core/types/decimal.h"

namespace semblante {
namespace {

std::vector<std::string_view> columns_of(std::string_view line) {
  std::vector<std::string_view> columns;
  for (;;) {
    const std::size_t tab = line.find('\t');
    columns.push_back(line.substr(0, tab));
    if (tab == std::string_view::npos) return columns;
    line.remove_prefix(tab + 1);
  }
}

}  // namespace

double ms_of_seconds(std::string_view text) { return 1000.0 * read_double(text).value_or(std::nan("")); }

void read_table(std::string_view file, std::size_t column_count, TimelineBuilder& builder) {
  each_line(file, builder, [&](std::string_view line, const std::string& where) {
    const auto columns = columns_of(line);
    if (columns.size() != column_count)
      return builder.fail(ErrorCode::malformed, where,
                          "must have " + std::to_string(column_count) + " columns between tabs");
    std::optional<double> end;
    if (column_count == 3) end = ms_of_seconds(columns[1]);
    builder.sound(columns.back(), ms_of_seconds(columns[0]), end, where);
  });
}

}  // namespace semblante

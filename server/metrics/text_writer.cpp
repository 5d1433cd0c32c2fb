#include "server/metrics/text_writer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>

namespace semblante::metrics {
namespace {

[[maybe_unused]] bool is_name(std::string_view text, bool of_label) {
  const auto first = [&](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (c == ':' && !of_label);
  };
  return !text.empty() && first(text.front()) &&
         std::all_of(text.begin(), text.end(), [&](char c) { return first(c) || (c >= '0' && c <= '9'); });
}

std::string_view type_name(MetricType type) {
  constexpr std::array<std::string_view, 3> names = {"counter", "gauge", "histogram"};
  return names[static_cast<std::size_t>(type)];
}

/// Escapes HELP text and label values; quotes are special in the latter only.
void append_escaped(std::string& out, std::string_view text, bool quoted) {
  for (const char c : text) {
    if (c == '\\')
      out.append("\\\\");
    else if (c == '\n')
      out.append("\\n");
    else if (c == '"' && quoted)
      out.append("\\\"");
    else
      out.push_back(c);
  }
}

/// Shortest text that reads back as the same number. `plain`: without an exponent, for readable bounds.
std::string to_text(double value, bool plain = false) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0 ? "+Inf" : "-Inf";
  std::array<char, 400> buffer{};
  const auto end = plain ? std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed)
                         : std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end.ptr};
}

}  // namespace

void TextWriter::family(std::string_view name, MetricType type, std::string_view help) {
  assert(is_name(name, false) && !help.empty());
  assert(name.ends_with("_total") == (type == MetricType::counter));
  [[maybe_unused]] const bool is_new = seen_.emplace(name).second;
  assert(is_new);
  name_ = name;
  type_ = type;
  text_.append("# HELP ").append(name).append(" ");
  append_escaped(text_, help, false);
  text_.append("\n# TYPE ").append(name).append(" ").append(type_name(type)).append("\n");
}

void TextWriter::line(std::string_view suffix, std::span<const Label> labels, std::string_view bound,
                      std::string_view number) {
  text_.append(name_).append(suffix);
  char before = '{';
  const auto label = [&](std::string_view name, std::string_view value) {
    assert(is_name(name, true));
    text_.push_back(before);
    text_.append(name).append("=\"");
    append_escaped(text_, value, true);
    text_.push_back('"');
    before = ',';
  };
  for (const auto& [name, value] : labels) label(name, value);
  if (!bound.empty()) label("le", bound);
  if (before == ',') text_.push_back('}');
  text_.append(" ").append(number).append("\n");
}

void TextWriter::sample(std::uint64_t value, std::span<const Label> labels) {
  assert(type_ != MetricType::histogram);
  line("", labels, "", std::to_string(value));
}

void TextWriter::sample(double value, std::span<const Label> labels) {
  assert(type_ != MetricType::histogram);
  line("", labels, "", to_text(value));
}

void TextWriter::write_histogram(std::span<const double> upper, std::span<const std::uint64_t> buckets, double sum,
                                 std::span<const Label> labels) {
  assert(type_ == MetricType::histogram && buckets.size() == upper.size() + 1);
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < upper.size(); ++i) {
    count += buckets[i];
    line("_bucket", labels, to_text(upper[i], true), std::to_string(count));
  }
  count += buckets.back();
  line("_bucket", labels, "+Inf", std::to_string(count));
  line("_sum", labels, "", to_text(sum));
  line("_count", labels, "", std::to_string(count));
}

}  // namespace semblante::metrics

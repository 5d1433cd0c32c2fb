#pragma once

#include <cstdint>
#include <initializer_list>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "server/metrics/histogram.h"

namespace semblante::metrics {

enum class MetricType { counter, gauge, histogram };

struct Label {
  std::string_view name;
  std::string_view value;  ///< any UTF-8; escaped when written
};

/// Writes Prometheus' text form 0.0.4, family by family. Names come from this program, so invalid ones are asserted.
class TextWriter {
 public:
  /// Begins a family with its HELP and TYPE; its samples follow. Only a counter's name ends in _total; each family is
  /// written once. A family may have no samples, so that its name is listed before the first event.
  void family(std::string_view name, MetricType type, std::string_view help);
  void sample(std::uint64_t value, std::span<const Label> labels = {});
  void sample(double value, std::span<const Label> labels = {});
  template <class Number>
  void sample(Number value, std::initializer_list<Label> labels) {
    sample(value, std::span<const Label>(labels.begin(), labels.size()));
  }
  /// The cumulative buckets, sum and count of one histogram.
  template <std::size_t Bounds>
  void histogram(const HistogramBounds<Bounds>& bounds, const HistogramValues<Bounds>& values,
                 std::span<const Label> labels = {}) {
    write_histogram(bounds.upper, values.buckets, values.sum, labels);
  }

  /// A family of one sample without labels.
  template <class Number>
  void single(std::string_view name, MetricType type, std::string_view help, Number value) {
    family(name, type, help);
    sample(value);
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void line(std::string_view suffix, std::span<const Label> labels, std::string_view bound, std::string_view number);
  void write_histogram(std::span<const double> upper, std::span<const std::uint64_t> buckets, double sum,
                       std::span<const Label> labels);

  std::string text_;
  std::string name_;
  MetricType type_ = MetricType::gauge;
  std::set<std::string, std::less<>> seen_;
};

}  // namespace semblante::metrics

#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace semblante::test {

struct PrometheusSample {
  std::string name;                           ///< with _bucket, _sum or _count of a histogram
  std::map<std::string, std::string> labels;  ///< unescaped
  double value = 0.0;
};

struct PrometheusFamily {
  std::string type, help;
  std::vector<PrometheusSample> samples;
};

/// A reader of the text form 0.0.4 that is stricter than Prometheus itself and shares no code with the writer: HELP and
/// TYPE exactly once, before the samples; samples together; names, escapes and numbers by the letter; no label or
/// series twice; counters end in _total, never negative; buckets rise, cumulate and end with +Inf, which equals _count.
struct PrometheusText {
  std::map<std::string, PrometheusFamily> families;
  std::vector<std::string> faults;  ///< with line numbers; empty when the text is right

  /// The value of a series without, or with exactly these labels; -1 when there is none.
  [[nodiscard]] double value(const std::string& name, const std::map<std::string, std::string>& labels = {}) const;
};

PrometheusText read_prometheus_text(std::string_view text);

}  // namespace semblante::test

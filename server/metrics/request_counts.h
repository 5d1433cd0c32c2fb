#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "server/metrics/histogram.h"
#include "server/metrics/text_writer.h"

namespace semblante::metrics {

/// Seconds to answer a request.
inline constexpr HistogramBounds<12> request_bounds{
    {0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 10.0}};

/// The unit of counting: a method and the pattern of a route, never a path chosen by a client.
struct RequestKind {
  std::string method, route;
};

/// Requests by kind and class of status, and their durations. The kinds are fixed at construction: neither memory nor
/// the number of series depends on clients. Any thread.
class RequestCounts {
 public:
  explicit RequestCounts(std::vector<RequestKind> kinds);

  /// `kind`: index into the kinds. `status`: 100 to 599.
  void count(std::size_t kind, int status, double seconds);
  /// Two families: semblante_http_requests_total and semblante_http_request_duration_seconds. Series without events are
  /// omitted.
  void write(TextWriter& writer) const;

 private:
  struct Counts {
    std::array<std::atomic<std::uint64_t>, 5> by_class{};  ///< 1xx to 5xx
    Histogram<request_bounds.upper.size()> seconds{request_bounds};
  };

  const std::vector<RequestKind> kinds_;
  const std::unique_ptr<Counts[]> counts_;
};

}  // namespace semblante::metrics

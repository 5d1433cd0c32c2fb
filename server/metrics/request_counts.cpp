#include "server/metrics/request_counts.h"

#include <cassert>
#include <utility>

namespace semblante::metrics {

RequestCounts::RequestCounts(std::vector<RequestKind> kinds)
    : kinds_(std::move(kinds)), counts_(std::make_unique<Counts[]>(kinds_.size())) {}

void RequestCounts::count(std::size_t kind, int status, double seconds) {
  assert(kind < kinds_.size() && status >= 100 && status < 600);
  auto& counts = counts_[kind];
  counts.by_class[static_cast<std::size_t>(status / 100 - 1)].fetch_add(1, std::memory_order_relaxed);
  counts.seconds.observe(seconds);
}

void RequestCounts::write(TextWriter& writer) const {
  static constexpr std::array<std::string_view, 5> classes = {"1xx", "2xx", "3xx", "4xx", "5xx"};
  writer.family("semblante_http_requests_total", MetricType::counter, "Requests answered.");
  for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
    for (std::size_t i = 0; i < classes.size(); ++i) {
      const auto count = counts_[kind].by_class[i].load(std::memory_order_relaxed);
      if (count == 0) continue;
      writer.sample(count, {{"method", kinds_[kind].method}, {"route", kinds_[kind].route}, {"status", classes[i]}});
    }
  }
  writer.family("semblante_http_request_duration_seconds", MetricType::histogram,
                "From the end of a request's header to the beginning of its answer, the time its body took included.");
  for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
    const auto values = counts_[kind].seconds.values();
    if (values.count() == 0) continue;
    const std::array<Label, 2> labels = {Label{"method", kinds_[kind].method}, Label{"route", kinds_[kind].route}};
    writer.histogram(request_bounds, values, labels);
  }
}

}  // namespace semblante::metrics

#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace semblante::metrics {

/// A histogram with fixed bounds, as in Prometheus. Any thread. Code with many values counts in its own HistogramPart
/// and adds that at once.
template <std::size_t Bounds>
struct HistogramBounds {
  std::array<double, Bounds> upper;  ///< of each bucket, inclusive, rising; a last bucket without bound follows
};

/// Seconds from the moment a batch was due until the kernel had it, per subscriber.
inline constexpr HistogramBounds<14> lateness_bounds{
    {0.0005, 0.001, 0.002, 0.005, 0.01, 0.02, 0.03, 0.05, 0.075, 0.1, 0.2, 0.5, 1.0, 5.0}};

/// A snapshot of a histogram. Its buckets are not cumulative.
template <std::size_t Bounds>
struct HistogramValues {
  std::array<std::uint64_t, Bounds + 1> buckets{};
  double sum = 0.0;  ///< of all values, each rounded to a microsecond

  [[nodiscard]] std::uint64_t count() const {
    std::uint64_t all = 0;
    for (const auto bucket : buckets) all += bucket;
    return all;
  }
  HistogramValues& operator+=(const HistogramValues& other) {
    for (std::size_t i = 0; i < buckets.size(); ++i) buckets[i] += other.buckets[i];
    sum += other.sum;
    return *this;
  }
};

template <std::size_t Bounds>
class HistogramPart {
 public:
  explicit constexpr HistogramPart(const HistogramBounds<Bounds>& bounds) : bounds_(bounds) {}

  void observe(double value, std::uint64_t times = 1) {
    std::size_t bucket = 0;
    while (bucket < Bounds && value > bounds_.upper[bucket]) ++bucket;
    buckets[bucket] += times;
    micros += static_cast<std::uint64_t>((value > 0.0 ? value : 0.0) * 1e6) * times;
  }

  std::array<std::uint64_t, Bounds + 1> buckets{};
  std::uint64_t micros = 0;

 private:
  const HistogramBounds<Bounds>& bounds_;
};

template <std::size_t Bounds>
class Histogram {
 public:
  explicit constexpr Histogram(const HistogramBounds<Bounds>& bounds) : bounds_(bounds) {}
  Histogram(const Histogram&) = delete;
  Histogram& operator=(const Histogram&) = delete;

  [[nodiscard]] const HistogramBounds<Bounds>& bounds() const { return bounds_; }
  void observe(double value) {
    HistogramPart<Bounds> one(bounds_);
    one.observe(value);
    add(one);
  }
  void add(const HistogramPart<Bounds>& part) {
    for (std::size_t i = 0; i < buckets_.size(); ++i)
      if (part.buckets[i] != 0) buckets_[i].fetch_add(part.buckets[i], std::memory_order_relaxed);
    micros_.fetch_add(part.micros, std::memory_order_relaxed);
  }
  [[nodiscard]] HistogramValues<Bounds> values() const {
    HistogramValues<Bounds> values;
    for (std::size_t i = 0; i < buckets_.size(); ++i) values.buckets[i] = buckets_[i].load(std::memory_order_relaxed);
    values.sum = static_cast<double>(micros_.load(std::memory_order_relaxed)) * 1e-6;
    return values;
  }

 private:
  const HistogramBounds<Bounds>& bounds_;
  std::array<std::atomic<std::uint64_t>, Bounds + 1> buckets_{};
  std::atomic<std::uint64_t> micros_{0};
};

using LatenessHistogram = Histogram<lateness_bounds.upper.size()>;
using LatenessPart = HistogramPart<lateness_bounds.upper.size()>;
using LatenessValues = HistogramValues<lateness_bounds.upper.size()>;

}  // namespace semblante::metrics

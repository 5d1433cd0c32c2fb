#include <cmath>
#include <limits>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/metrics/process_metrics.h"
#include "server/metrics/request_counts.h"
#include "server/metrics/text_writer.h"
#include "tests/support/prometheus_text.h"

namespace semblante::metrics {
namespace {

using test::read_prometheus_text;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(TextWriter, WritesWhatAStrictReaderReadsBack) {
  TextWriter writer;
  writer.family("a_total", MetricType::counter, "With a \\ and\na line.");
  writer.sample(std::uint64_t{18'446'744'073'709'551'615U}, {{"name", "quote \" back \\ line\n end"}});
  writer.sample(0.5, {{"name", ""}, {"other", "x"}});
  writer.family("nothing_yet", MetricType::gauge, "No sample.");
  writer.single("small", MetricType::gauge, "Not rounded.", 1.25e-7);
  const auto text = read_prometheus_text(writer.text());
  EXPECT_THAT(text.faults, IsEmpty());
  EXPECT_EQ(text.families.size(), 3U);
  EXPECT_EQ(text.value("a_total", {{"name", "quote \" back \\ line\n end"}}), 18'446'744'073'709'551'615.0);
  EXPECT_EQ(text.value("a_total", {{"name", ""}, {"other", "x"}}), 0.5);
  EXPECT_EQ(text.value("small"), 1.25e-7);
  EXPECT_EQ(text.families.at("nothing_yet").type, "gauge");
}

TEST(TextWriter, Histogram_IsCumulative) {
  constexpr HistogramBounds<3> bounds{{0.0005, 0.01, 2.0}};
  Histogram<3> histogram(bounds);
  for (const double seconds : {0.0001, 0.0005, 0.005, 5.0}) histogram.observe(seconds);
  TextWriter writer;
  writer.family("seconds", MetricType::histogram, "Some.");
  const Label label{"of", "a"};
  writer.histogram(bounds, histogram.values(), std::span(&label, 1));
  const auto text = read_prometheus_text(writer.text());
  EXPECT_THAT(text.faults, IsEmpty()) << writer.text();
  EXPECT_EQ(text.value("seconds_bucket", {{"of", "a"}, {"le", "0.0005"}}), 2.0) << "a bound belongs to its bucket";
  EXPECT_EQ(text.value("seconds_bucket", {{"of", "a"}, {"le", "0.01"}}), 3.0);
  EXPECT_EQ(text.value("seconds_bucket", {{"of", "a"}, {"le", "2"}}), 3.0);
  EXPECT_EQ(text.value("seconds_bucket", {{"of", "a"}, {"le", "+Inf"}}), 4.0);
  EXPECT_EQ(text.value("seconds_count", {{"of", "a"}}), 4.0);
  EXPECT_NEAR(text.value("seconds_sum", {{"of", "a"}}), 5.0056, 1e-5);
}

/// The reader must find these, or the tests that use it prove nothing.
TEST(StrictReader, FindsFault) {
  const std::string head = "# HELP a_total A.\n# TYPE a_total counter\n";
  const std::string histogram = "# HELP h H.\n# TYPE h histogram\n";
  EXPECT_THAT(read_prometheus_text(head + "a_total 1\n").faults, IsEmpty());
  for (const std::string& bad : std::vector<std::string>{
           head + "a_total 1",                     // no line end
           head + "a_total 1\na_total 2\n",        // twice
           head + "a_total{x=\"1\",x=\"2\"} 1\n",  // label twice
           head + "a_total{x=\"1\",} 1\n",         // comma too much
           head + "a_total{x=\"\\t\"} 1\n",        // unknown escape
           head + "a_total{x=\"1} 1\n",            // open quote
           head + "a_total{1x=\"1\"} 1\n",         // label name
           head + "a_total -1\n",                  // counter below zero
           head + "a_total nan\n",
           head + "a_total 1 \n",
           head + "a_total  1\n",
           head + "a_total\n",
           head + "b_total 1\n",                                 // family unknown
           head + head + "a_total 1\n",                          // family twice
           std::string("a_total 1\n"),                           // no family
           std::string("# TYPE a_total counter\na_total 1\n"),   // no HELP
           std::string("# HELP a A.\n# TYPE a counter\na 1\n"),  // counter without _total
           std::string("# HELP a_total A.\n# TYPE a_total gauge\n"),
           std::string("# HELP a A.\n# TYPE a summary\n"),
           std::string("# a comment of no use\n"),
           histogram + "h_bucket{le=\"1\"} 1\nh_sum 1\nh_count 1\n",                           // no +Inf
           histogram + "h_bucket{le=\"1\"} 2\nh_bucket{le=\"+Inf\"} 1\nh_sum 1\nh_count 1\n",  // falls
           histogram + "h_bucket{le=\"2\"} 1\nh_bucket{le=\"1\"} 1\nh_bucket{le=\"+Inf\"} 1\nh_sum 1\nh_count 1\n",
           histogram + "h_bucket{le=\"+Inf\"} 1\nh_sum 1\nh_count 2\n",
           histogram + "h_bucket{le=\"+Inf\"} 1\nh_count 1\n",
           histogram + "h_bucket 1\nh_sum 1\nh_count 1\n",
           histogram + "h 1\n",
       })
    EXPECT_THAT(read_prometheus_text(bad).faults, Not(IsEmpty())) << bad;
}

TEST(ProcessMetrics, AreThereAndPlausible) {
  TextWriter writer;
  write_process_metrics(writer);
  const auto text = read_prometheus_text(writer.text());
  EXPECT_THAT(text.faults, IsEmpty());
  EXPECT_GE(text.value("process_cpu_seconds_total"), 0.0);
  EXPECT_GT(text.value("process_resident_memory_bytes"), 100'000.0);
  EXPECT_GT(text.value("process_virtual_memory_bytes"), text.value("process_resident_memory_bytes"));
  EXPECT_GE(text.value("process_open_fds"), 3.0);
  EXPECT_GE(text.value("process_max_fds"), text.value("process_open_fds"));
  EXPECT_GE(text.value("process_threads"), 1.0);
  const auto now = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  EXPECT_GT(text.value("process_start_time_seconds"), now - 3600.0);
  EXPECT_LT(text.value("process_start_time_seconds"), now + 5.0);
}

TEST(RequestCounts, CountByKindAndClass_FromAnyThread) {
  RequestCounts counts({{"GET", "/a/{b}"}, {"POST", "/a"}});
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      for (int k = 0; k < 1000; ++k) counts.count(0, k % 2 == 0 ? 200 : 404, 0.003);
    });
  for (auto& thread : threads) thread.join();
  TextWriter writer;
  counts.write(writer);
  const auto text = read_prometheus_text(writer.text());
  EXPECT_THAT(text.faults, IsEmpty());
  const std::map<std::string, std::string> good = {{"method", "GET"}, {"route", "/a/{b}"}, {"status", "2xx"}};
  EXPECT_EQ(text.value("semblante_http_requests_total", good), 2000.0);
  EXPECT_EQ(text.value("semblante_http_request_duration_seconds_count", {{"method", "GET"}, {"route", "/a/{b}"}}),
            4000.0);
  EXPECT_THAT(writer.text(), Not(HasSubstr("POST"))) << "what never happened takes no room";
}

}  // namespace
}  // namespace semblante::metrics

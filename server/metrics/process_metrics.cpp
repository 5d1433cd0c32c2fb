#include "server/metrics/process_metrics.h"

#include <charconv>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vector>

#include <sys/resource.h>

namespace semblante::metrics {
namespace {

/// Fields of /proc/self/stat after the command's name, which may contain blanks: field 3 (the state) is the first.
std::vector<std::string> stat_fields() {
  std::ifstream file("/proc/self/stat");
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const auto end = text.rfind(')');
  std::vector<std::string> fields;
  if (end == std::string::npos) return fields;
  std::istringstream rest(text.substr(end + 1));
  for (std::string field; rest >> field;) fields.push_back(field);
  return fields;
}

std::optional<double> number(const std::vector<std::string>& fields, std::size_t field) {
  constexpr std::size_t first = 3;
  if (field - first >= fields.size()) return std::nullopt;
  const auto& text = fields[field - first];
  double value = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec != std::errc()) return std::nullopt;
  return value;
}

/// When the machine started, seconds since 1970.
std::optional<double> boot_time() {
  std::ifstream file("/proc/stat");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("btime ")) continue;
    double value = 0.0;
    const auto read = std::from_chars(line.data() + 6, line.data() + line.size(), value);
    if (read.ec == std::errc()) return value;
  }
  return std::nullopt;
}

std::optional<double> open_descriptors() {
  std::error_code error;
  double count = 0.0;
  for (std::filesystem::directory_iterator entry("/proc/self/fd", error), end; !error && entry != end;
       entry.increment(error))
    ++count;
  if (error || count == 0.0) return std::nullopt;
  return count - 1.0;  // without the descriptor that reads the folder
}

}  // namespace

void write_process_metrics(TextWriter& writer) {
  const auto fields = stat_fields();
  const auto ticks = static_cast<double>(::sysconf(_SC_CLK_TCK));
  const auto page = static_cast<double>(::sysconf(_SC_PAGESIZE));
  const auto write = [&](std::string_view name, MetricType type, std::string_view help, std::optional<double> value) {
    writer.family(name, type, help);
    if (value) writer.sample(*value);
  };
  const auto product = [](std::optional<double> a, double factor) {
    return a ? std::optional(*a * factor) : std::nullopt;
  };
  const auto sum = [](std::optional<double> a, std::optional<double> b) {
    return a && b ? std::optional(*a + *b) : std::nullopt;
  };
  // By proc(5): 14 and 15 are user and system time, 20 threads, 22 the start, 23 and 24 the memory.
  write("process_cpu_seconds_total", MetricType::counter, "Processor time of the process, user and system.",
        product(sum(number(fields, 14), number(fields, 15)), 1.0 / ticks));
  write("process_start_time_seconds", MetricType::gauge, "When the process started, since 1970-01-01 UTC.",
        sum(boot_time(), product(number(fields, 22), 1.0 / ticks)));
  write("process_threads", MetricType::gauge, "Threads of the process.", number(fields, 20));
  write("process_virtual_memory_bytes", MetricType::gauge, "Address space of the process.", number(fields, 23));
  write("process_resident_memory_bytes", MetricType::gauge, "Resident memory of the process.",
        product(number(fields, 24), page));
  write("process_open_fds", MetricType::gauge, "Open file descriptors of the process.", open_descriptors());
  rlimit limit{};
  const bool known = ::getrlimit(RLIMIT_NOFILE, &limit) == 0;
  write("process_max_fds", MetricType::gauge, "File descriptors the process may have open.",
        known ? std::optional(static_cast<double>(limit.rlim_cur)) : std::nullopt);
}

}  // namespace semblante::metrics

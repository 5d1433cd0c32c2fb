#include "server/log/log.h"

#include <array>
#include <atomic>
#include <chrono>
#include <ctime>
#include <string>
#include <unistd.h>

namespace semblante::log {
namespace {

std::atomic<Level> lowest{Level::info};
constexpr std::array<std::string_view, 4> names = {"debug", "info", "warning", "error"};

}  // namespace

std::optional<Level> parse_level(std::string_view name) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return static_cast<Level>(i);
  return std::nullopt;
}

void set_level(Level level) { lowest = level; }
bool enabled(Level level) { return level >= lowest; }

void write(Level level, std::string_view message) {
  if (!enabled(level)) return;
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> stamp{};
  std::strftime(stamp.data(), stamp.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  std::string line(stamp.data());
  line.append(" ").append(names[static_cast<std::size_t>(level)]).append(" ");
  for (const char c : message) line.push_back(static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? '?' : c);
  line.push_back('\n');
  // One write call per line keeps lines of several threads intact; a full disk must not stop the server.
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, line.data(), line.size());
}

}  // namespace semblante::log

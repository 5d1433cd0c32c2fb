#include "server/log/log.h"

#include <array>
#include <atomic>
#include <chrono>
#include <ctime>
#include <string>
#include <unistd.h>
#include <utility>

#include <nlohmann/json.hpp>

namespace semblante::log {
namespace {

std::atomic<Level> lowest{Level::info};
std::atomic<Format> format{Format::text};
thread_local const About* about = nullptr;
constexpr std::array<std::string_view, 4> level_names = {"debug", "info", "warning", "error"};
constexpr std::array<std::string_view, 2> format_names = {"text", "json"};

template <class Value, std::size_t size>
std::optional<Value> parse(std::string_view name, const std::array<std::string_view, size>& names) {
  for (std::size_t i = 0; i < size; ++i)
    if (names[i] == name) return static_cast<Value>(i);
  return std::nullopt;
}

std::string without_controls(std::string_view text) {
  std::string clean(text);
  for (char& c : clean)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
  return clean;
}

std::string text_line(const std::string& time, std::string_view level, std::string_view message, const About& subject) {
  auto line = time;
  line.append(" ").append(level).append(" ").append(without_controls(message));
  if (!subject.request.empty()) line.append(" [request ").append(subject.request).append("]");
  if (!subject.job.empty()) line.append(" [job ").append(subject.job).append("]");
  return line;
}

std::string json_line(const std::string& time, std::string_view level, std::string_view message, const About& subject) {
  nlohmann::ordered_json line = {{"time", time}, {"level", level}, {"message", without_controls(message)}};
  if (!subject.request.empty()) line["request"] = subject.request;
  if (!subject.job.empty()) line["job"] = subject.job;
  return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string time_in_utc() {
  const auto now = std::chrono::system_clock::now();
  const std::time_t seconds = std::chrono::system_clock::to_time_t(now);
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  std::array<char, 32> stamp{};
  std::strftime(stamp.data(), stamp.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return stamp.data();
}

}  // namespace

std::optional<Level> parse_level(std::string_view name) { return parse<Level>(name, level_names); }
void set_level(Level level) { lowest = level; }
bool enabled(Level level) { return level >= lowest; }

std::optional<Format> parse_format(std::string_view name) { return parse<Format>(name, format_names); }
void set_format(Format chosen) { format = chosen; }

Scope::Scope(About subject) : about_(std::move(subject)), before_(std::exchange(about, &about_)) {
  if (before_ == nullptr) return;
  if (about_.request.empty()) about_.request = before_->request;
  if (about_.job.empty()) about_.job = before_->job;
}

Scope::~Scope() { about = before_; }

void write(Level level, std::string_view message) {
  if (!enabled(level)) return;
  const About subject = about == nullptr ? About{} : *about;
  const auto name = level_names[static_cast<std::size_t>(level)];
  auto line = format == Format::json ? json_line(time_in_utc(), name, message, subject)
                                     : text_line(time_in_utc(), name, message, subject);
  line.push_back('\n');
  // One write call per line keeps lines of several threads intact; a full disk must not stop the server.
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, line.data(), line.size());
}

}  // namespace semblante::log

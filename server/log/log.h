#pragma once

#include <optional>
#include <string_view>

namespace semblante::log {

enum class Level { debug, info, warning, error };

/// "debug", "info", "warning", "error".
std::optional<Level> parse_level(std::string_view name);
/// Suppresses lines below this level from now on. Default: info.
void set_level(Level level);
[[nodiscard]] bool enabled(Level level);

/// One line to standard error: time in UTC, level, message. Whole lines, from any thread. Line breaks and control
/// characters of the message (it may quote a client) are written as '?', so that no client can forge a line.
void write(Level level, std::string_view message);
inline void debug(std::string_view message) { write(Level::debug, message); }
inline void info(std::string_view message) { write(Level::info, message); }
inline void warning(std::string_view message) { write(Level::warning, message); }
inline void error(std::string_view message) { write(Level::error, message); }

}  // namespace semblante::log

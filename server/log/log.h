#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace semblante::log {

enum class Level { debug, info, warning, error };

/// "debug", "info", "warning", "error".
std::optional<Level> parse_level(std::string_view name);
/// Suppresses lines below this level from now on. Default: info.
void set_level(Level level);
[[nodiscard]] bool enabled(Level level);

enum class Format {
  text,  ///< time, level, message, and what the line is about in brackets
  json,  ///< an object with the members time, level, message and, where they are known, request and job
};
/// "text", "json".
std::optional<Format> parse_format(std::string_view name);
/// Of all lines from now on. Default: text.
void set_format(Format format);

/// What the lines of a thread are about.
struct About {
  std::string request = {};  ///< id of the request
  std::string job = {};      ///< id of the job
};

/// Lines of this thread are about this until the object goes. Not to be held while a coroutine is suspended, which may
/// go on in another thread.
class Scope {
 public:
  explicit Scope(About about);
  ~Scope();
  Scope(const Scope&) = delete;
  Scope& operator=(const Scope&) = delete;

 private:
  About about_;
  const About* before_;
};

/// One line to standard error, with its time in UTC. Whole lines, from any thread. Line breaks and control characters
/// of the message (it may quote a client) are written as '?', so that no client can forge a line.
void write(Level level, std::string_view message);
inline void debug(std::string_view message) { write(Level::debug, message); }
inline void info(std::string_view message) { write(Level::info, message); }
inline void warning(std::string_view message) { write(Level::warning, message); }
inline void error(std::string_view message) { write(Level::error, message); }

}  // namespace semblante::log

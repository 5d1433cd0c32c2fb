#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace semblante::streams {

/// What can feed a stream. `connection` publishes over a WebSocket, `request` sends frames by REST, `performance`,
/// `fap` and `recording` are played, `demo` is a stream's own filling. README.md has the rules of precedence.
enum class Source { connection, request, performance, fap, recording, demo };

inline constexpr std::array<std::string_view, 6> source_names = {"connection", "request",   "performance",
                                                                 "fap",        "recording", "demo"};
inline constexpr std::size_t source_count = source_names.size();

/// The source for a name of FrameSource::kind; `performance` for any other name.
constexpr Source played_source(std::string_view kind) {
  for (const auto source : {Source::fap, Source::recording})
    if (kind == source_names[static_cast<std::size_t>(source)]) return source;
  return Source::performance;
}

}  // namespace semblante::streams

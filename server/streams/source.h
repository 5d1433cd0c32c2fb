#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace semblante::streams {

/// Who feeds a stream; README.md has the rules between them. `connection` publishes over a WebSocket, `request` is
/// frames by REST, `performance`, `fap` and `recording` are played, `demo` is a stream's own filling.
enum class Source { connection, request, performance, fap, recording, demo };

inline constexpr std::array<std::string_view, 6> source_names = {"connection", "request",   "performance",
                                                                 "fap",        "recording", "demo"};
inline constexpr std::size_t source_count = source_names.size();

/// What of the name FrameSource::kind gives; a performance if it is none of these.
constexpr Source played_source(std::string_view kind) {
  for (const auto source : {Source::fap, Source::recording})
    if (kind == source_names[static_cast<std::size_t>(source)]) return source;
  return Source::performance;
}

}  // namespace semblante::streams

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "protocol/cpp/face_frame.h"

namespace semblante {

inline constexpr std::uint32_t protocol_version = 1;
inline constexpr std::string_view binary_subprotocol = "semblante.v1";
inline constexpr std::string_view json_subprotocol = "semblante.v1.json";

enum class StreamRole : std::uint8_t { subscribe, publish };
enum class EndReason : std::uint8_t { other, finished, deleted, shutdown, replaced, slow };
enum class StreamErrorCode : std::uint8_t {
  other,
  malformed,
  truncated,
  out_of_range,
  not_finite,
  too_large,
  unsupported,
  mismatch,
  missing,
  invalid_argument,
  not_found,
  conflict,
  throttled,
  unauthorized,
  internal
};

/// Where a client that lost its connection stopped: the last frame it has.
struct ResumePoint {
  std::uint64_t epoch = 0;
  std::uint64_t sequence = 0;
  friend bool operator==(const ResumePoint&, const ResumePoint&) = default;
};

/// First message of a client.
struct Hello {
  std::uint32_t version = protocol_version;
  StreamRole role = StreamRole::subscribe;
  std::optional<ResumePoint> resume;
  friend bool operator==(const Hello&, const Hello&) = default;
};

/// First message of a server: what the stream is and how to read it.
struct Header {
  std::uint32_t version = protocol_version;
  std::string stream;
  std::string title;
  std::string model;                 ///< id of the model the stream suggests; may be empty
  std::uint64_t epoch = 0;           ///< sequence numbers are comparable within one epoch only
  std::uint64_t sequence = 0;        ///< of the newest frame the stream has had; 0 before the first
  std::uint64_t media_time = 0;      ///< ms, of the stream's clock now
  double server_time = 0.0;          ///< ms since 1970-01-01 UTC
  double fps_hint = 0.0;             ///< frames per second the stream means to send, 0: unknown
  std::uint32_t batch_interval = 0;  ///< ms between messages the server means to send, 0: unknown
  std::vector<double> quantizers;    ///< steps of FAPs 3..68 in FAP units; empty: the standard ones
  bool recovered = false;            ///< true: everything after `resume` follows, nothing was lost
  friend bool operator==(const Header&, const Header&) = default;
};

/// The full state at one moment: a decoder can start here.
struct Keyframe {
  std::uint64_t sequence = 0;
  std::uint64_t media_time = 0;  ///< ms
  FaceFrame state;
  friend bool operator==(const Keyframe&, const Keyframe&) = default;
};

/// A batch: frame i has sequence number `sequence` + i and happens at media_time + frames[i].time.
struct Frames {
  std::uint64_t sequence = 0;
  std::uint64_t media_time = 0;  ///< ms
  std::vector<TimedFrame> frames;
  friend bool operator==(const Frames&, const Frames&) = default;
};

/// Nothing more comes.
struct End {
  EndReason reason = EndReason::other;
  friend bool operator==(const End&, const End&) = default;
};

/// Something the peer sent was refused. `where` is a JSON pointer into the message (both subprotocols).
struct StreamError {
  StreamErrorCode code = StreamErrorCode::other;
  std::string where;
  std::string message;
  friend bool operator==(const StreamError&, const StreamError&) = default;
};

struct Ping {
  std::uint32_t id = 0;
  double client_time = 0.0;  ///< ms of the asking side's own clock, of any origin
  friend bool operator==(const Ping&, const Ping&) = default;
};

struct Pong {
  std::uint32_t id = 0;
  double client_time = 0.0;      ///< as it came in the ping
  double server_time = 0.0;      ///< ms since 1970-01-01 UTC when the ping was read
  std::uint64_t media_time = 0;  ///< ms, of the stream's clock at that moment
  friend bool operator==(const Pong&, const Pong&) = default;
};

using Message = std::variant<Hello, Header, Keyframe, Frames, End, StreamError, Ping, Pong>;

}  // namespace semblante

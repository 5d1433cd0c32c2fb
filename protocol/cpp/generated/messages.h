// Generated from protocol/schema by semblante-codegen-protocol; change the schema, not this.
// clang-format off
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "protocol/cpp/face_frame.h"

namespace semblante {

/// Whether a field may be left out: a JSON member absent; one that was appended also of the binary form, whose message
/// may end before it.
enum class Presence : std::uint8_t { required, defaulted, appended };

/// Texts of an enumeration by value. An open one reads values it does not know as its first.
struct EnumNames {
  std::span<const std::string_view> names;
  bool open;
};

inline constexpr double max_real = std::numeric_limits<double>::max();

inline constexpr std::uint32_t protocol_version = 1;
inline constexpr std::string_view binary_subprotocol = "semblante.v1";
inline constexpr std::string_view json_subprotocol = "semblante.v1.json";

inline constexpr std::size_t max_binary_message_bytes = 262144;
inline constexpr std::size_t max_json_message_bytes = 1048576;
inline constexpr std::size_t max_frames_per_message = 1024;
inline constexpr std::size_t max_frame_time = 86400000;
inline constexpr std::size_t max_level = 32767;
inline constexpr std::size_t max_sound_packet_bytes = 4000;
inline constexpr std::size_t max_speech_text_bytes = 2000;
inline constexpr std::size_t max_score_bytes = 4000;

/// The role of a client in the stream.
enum class StreamRole : std::uint8_t {
  subscribe,  ///< to receive frames
  publish,  ///< to send frames
};
inline constexpr std::array<std::string_view, 2> stream_role_value_names = {"subscribe", "publish"};
inline constexpr EnumNames stream_role_names{stream_role_value_names, false};

/// Why a stream or a connection ends.
enum class EndReason : std::uint8_t {
  other,  ///< a reason unknown to this version
  finished,  ///< the source has ended
  deleted,  ///< the stream was deleted
  shutdown,  ///< the server shuts down; reconnect later
  replaced,  ///< another publisher took over
  slow,  ///< the receiver is too slow
};
inline constexpr std::array<std::string_view, 6> end_reason_value_names = {"other", "finished", "deleted", "shutdown", "replaced", "slow"};
inline constexpr EnumNames end_reason_names{end_reason_value_names, true};

/// How the packets of a sound are coded.
enum class SoundCodec : std::uint8_t {
  other,  ///< a codec unknown to this version
  opus,  ///< RFC 6716, without container
};
inline constexpr std::array<std::string_view, 2> sound_codec_value_names = {"other", "opus"};
inline constexpr EnumNames sound_codec_names{sound_codec_value_names, true};

/// What the client's own voice does.
enum class VoiceState : std::uint8_t {
  reached,  ///< it begins the word at `character`
  ended,  ///< it has said the text, or was silenced
  failed,  ///< it cannot speak: the client is to get frames from now on
  ready,  ///< it can speak: the client is to get text from now on
};
inline constexpr std::array<std::string_view, 4> voice_state_value_names = {"reached", "ended", "failed", "ready"};
inline constexpr EnumNames voice_state_names{voice_state_value_names, false};

/// The kind of error in a message.
enum class StreamErrorCode : std::uint8_t {
  other,  ///< an error unknown to this version
  malformed,  ///< invalid syntax, or a value of the wrong type
  truncated,  ///< ends before its declared content
  out_of_range,  ///< a number outside its range
  not_finite,  ///< NaN or infinity
  too_large,  ///< over a limit
  unsupported,  ///< an unknown version or message type
  mismatch,  ///< inconsistent with earlier messages: frames without a keyframe, or after a gap
  missing,  ///< a required member is absent
  invalid_argument,  ///< a value without meaning here
  not_found,  ///< no such stream
  conflict,  ///< the stream already has a source
  throttled,  ///< over the rate limit
  unauthorized,  ///< the client may not have this role
  internal,  ///< an error of the server
};
inline constexpr std::array<std::string_view, 15> stream_error_code_value_names = {"other", "malformed", "truncated", "out_of_range", "not_finite", "too_large", "unsupported", "mismatch", "missing", "invalid_argument", "not_found", "conflict", "throttled", "unauthorized", "internal"};
inline constexpr EnumNames stream_error_code_names{stream_error_code_value_names, true};

/// The last frame that a client received before it lost its connection.
struct ResumePoint {
  std::uint64_t epoch = 0;  ///< epoch of the last header
  std::uint64_t sequence = 0;  ///< number of the last frame received
  friend bool operator==(const ResumePoint&, const ResumePoint&) = default;
};

/// The sound of a stream.
struct SoundTrack {
  SoundCodec codec{};
  std::uint32_t rate = 0;  ///< 1/s; samples per second of the decoded sound
  std::uint32_t channels = 0;
  std::uint32_t bitrate = 0;  ///< bit/s; while somebody speaks; 0: unknown
  friend bool operator==(const SoundTrack&, const SoundTrack&) = default;
};

/// The first message of a client.
struct Hello {
  std::uint32_t version = 1;  ///< highest protocol version the client knows
  StreamRole role{};
  std::optional<ResumePoint> resume;  ///< present after a lost connection
  bool take_over = false;  ///< for a publisher: replace the current source
  bool sound = false;  ///< for a subscriber: send the sound too; for a publisher: it sends sound
  bool text = false;  ///< for a subscriber with a voice of its own: send text in place of frames and sound of speech
  bool captions = false;  ///< for a subscriber that shows what is said: send text beside frames and sound of speech
  friend bool operator==(const Hello&, const Hello&) = default;
};

/// The first message of a server: properties of the stream and its encoding.
struct Header {
  std::uint32_t version = 1;  ///< protocol version of this connection
  std::string stream;  ///< id of the stream
  std::string title;  ///< for display; may be empty
  std::string model;  ///< id of the suggested model; may be empty
  std::uint64_t epoch = 0;  ///< sequence numbers are only comparable within one epoch
  std::uint64_t sequence = 0;  ///< number of the stream's newest frame; 0 before the first
  std::uint64_t media_time = 0;  ///< ms; current time of the stream's clock
  double server_time = 0.0;  ///< ms; since 1970-01-01 UTC
  double fps_hint = 0.0;  ///< 1/s; intended frames per second; 0: unknown
  std::uint32_t batch_interval = 0;  ///< ms; intended time between messages; 0: unknown
  std::vector<double> quantizers;  ///< FAP units; steps of FAPs 3 to 68; empty: the standard steps
  bool recovered = false;  ///< all frames after the resume point follow: none was lost
  std::optional<double> viseme_share;  ///< viseme share of Eq. 5, in place of rig.json's; absent: rig.json's
  std::optional<SoundTrack> sound;  ///< the sound that may follow; absent: none was asked for, or the server has none
  friend bool operator==(const Header&, const Header&) = default;
};

/// The complete state at one moment, from which a reader can start.
struct Keyframe {
  std::uint64_t sequence = 0;  ///< number of this frame; 0: before the first
  std::uint64_t media_time = 0;  ///< ms
  FaceFrame state;
  friend bool operator==(const Keyframe&, const Keyframe&) = default;
};

/// A batch: frame i has the sequence number `sequence` + i and the media time `media_time` + its own time.
struct Frames {
  std::uint64_t sequence = 0;  ///< number of the first frame; 0 (from a publisher): the next number
  std::uint64_t media_time = 0;  ///< ms; 0 (from a publisher): now
  std::vector<TimedFrame> frames;  ///< 1 to 1024 frames
  friend bool operator==(const Frames&, const Frames&) = default;
};

/// The last message of a connection.
struct End {
  EndReason reason{};
  friend bool operator==(const End&, const End&) = default;
};

/// A message was refused; the connection stays open unless it is closed as well.
struct StreamError {
  StreamErrorCode code{};
  std::string where;  ///< JSON pointer to the invalid part of the message, in both subprotocols
  std::string message;  ///< for display
  friend bool operator==(const StreamError&, const StreamError&) = default;
};

/// One packet of the sound. Nothing is heard between the end of a packet and a later beginning of the next one.
struct SoundPacket {
  std::uint64_t media_time = 0;  ///< ms; when its first sample is heard, on the clock of the frames
  std::vector<std::uint8_t> packet;  ///< one packet of the header's codec
  friend bool operator==(const SoundPacket&, const SoundPacket&) = default;
};

/// A sentence of a speech, for the client's own voice or for captions. An empty text: what is being said, and what waits, is to stop.
struct SpeechText {
  std::uint64_t speech = 0;  ///< number of this text within the epoch; increases
  std::uint64_t media_time = 0;  ///< ms; when its first word is to begin, on the clock of the frames
  std::string language;  ///< tag of BCP 47; empty: unknown
  std::string text;
  std::vector<std::uint8_t> score;  ///< what the mouth does when, as section 2.2 has it
  friend bool operator==(const SpeechText&, const SpeechText&) = default;
};

/// What the client's own voice does with a text.
struct Spoken {
  VoiceState state{};
  std::uint64_t speech = 0;  ///< number of the text; 0: none
  std::uint32_t character = 0;  ///< number of characters (code points) of the text before the place that is reached
  std::uint64_t media_time = 0;  ///< ms; when it was, on the stream's clock; 0: unknown
  friend bool operator==(const Spoken&, const Spoken&) = default;
};

/// Changes the wish of the hello: whether text comes beside frames and sound of speech.
struct CaptionsWish {
  bool on = false;
  friend bool operator==(const CaptionsWish&, const CaptionsWish&) = default;
};

/// Requests the clocks of server and stream.
struct Ping {
  std::uint32_t id = 0;  ///< returned in the pong
  double client_time = 0.0;  ///< ms; the client's own clock, with any origin
  friend bool operator==(const Ping&, const Ping&) = default;
};

/// The response to a ping.
struct Pong {
  std::uint32_t id = 0;  ///< id of the ping
  double client_time = 0.0;  ///< ms; as in the ping
  double server_time = 0.0;  ///< ms; since 1970-01-01 UTC, when the server read the ping
  std::uint64_t media_time = 0;  ///< ms; the stream's clock at that moment
  friend bool operator==(const Pong&, const Pong&) = default;
};

using Message = std::variant<Hello, Header, Keyframe, Frames, End, StreamError, SoundPacket, SpeechText, Spoken, CaptionsWish, Ping, Pong>;

/// First byte of the binary form and `type` of the JSON form, for each message.
template <class M>
struct MessageTraits;
template <>
struct MessageTraits<Hello> {
  static constexpr std::uint8_t type = 1;
  static constexpr std::string_view name = "hello";
};
template <>
struct MessageTraits<Header> {
  static constexpr std::uint8_t type = 2;
  static constexpr std::string_view name = "header";
};
template <>
struct MessageTraits<Keyframe> {
  static constexpr std::uint8_t type = 9;
  static constexpr std::string_view name = "keyframe";
};
template <>
struct MessageTraits<Frames> {
  static constexpr std::uint8_t type = 128;
  static constexpr std::string_view name = "frames";
};
template <>
struct MessageTraits<End> {
  static constexpr std::uint8_t type = 5;
  static constexpr std::string_view name = "end";
};
template <>
struct MessageTraits<StreamError> {
  static constexpr std::uint8_t type = 6;
  static constexpr std::string_view name = "error";
};
template <>
struct MessageTraits<SoundPacket> {
  static constexpr std::uint8_t type = 10;
  static constexpr std::string_view name = "sound";
};
template <>
struct MessageTraits<SpeechText> {
  static constexpr std::uint8_t type = 11;
  static constexpr std::string_view name = "text";
};
template <>
struct MessageTraits<Spoken> {
  static constexpr std::uint8_t type = 12;
  static constexpr std::string_view name = "spoken";
};
template <>
struct MessageTraits<CaptionsWish> {
  static constexpr std::uint8_t type = 14;
  static constexpr std::string_view name = "captions";
};
template <>
struct MessageTraits<Ping> {
  static constexpr std::uint8_t type = 7;
  static constexpr std::string_view name = "ping";
};
template <>
struct MessageTraits<Pong> {
  static constexpr std::uint8_t type = 8;
  static constexpr std::string_view name = "pong";
};

// visit_fields calls one method of `v` per field, in the order of the binary form.

template <class M, class V>
  requires std::same_as<std::remove_const_t<M>, ResumePoint>
void visit_fields(M& m, V& v) {
  v.uint("epoch", m.epoch, 9007199254740991U, Presence::required);
  v.uint("sequence", m.sequence, 9007199254740991U, Presence::required);
}

template <class M, class V>
  requires std::same_as<std::remove_const_t<M>, SoundTrack>
void visit_fields(M& m, V& v) {
  v.enumeration("codec", m.codec, sound_codec_names, Presence::defaulted);
  v.uint("rate", m.rate, 192000U, Presence::defaulted);
  v.uint("channels", m.channels, 2U, Presence::defaulted);
  v.uint("bitrate", m.bitrate, 4294967295U, Presence::defaulted);
}

template <class M, class V>
  requires std::same_as<std::remove_const_t<M>, Hello>
void visit_fields(M& m, V& v) {
  v.uint("version", m.version, 65535U, Presence::required);
  v.enumeration("role", m.role, stream_role_names, Presence::defaulted);
  v.optional("resume", m.resume, Presence::defaulted);
  v.boolean("take_over", m.take_over, Presence::appended);
  v.boolean("sound", m.sound, Presence::appended);
  v.boolean("text", m.text, Presence::appended);
  v.boolean("captions", m.captions, Presence::appended);
}

template <class M, class V>
  requires std::same_as<std::remove_const_t<M>, Header>
void visit_fields(M& m, V& v) {
  v.uint("version", m.version, 65535U, Presence::required);
  v.text("stream", m.stream, 256, Presence::required);
  v.text("title", m.title, 1024, Presence::defaulted);
  v.text("model", m.model, 256, Presence::defaulted);
  v.uint("epoch", m.epoch, 9007199254740991U, Presence::required);
  v.uint("sequence", m.sequence, 9007199254740991U, Presence::required);
  v.uint("media_time", m.media_time, 9007199254740991U, Presence::required);
  v.real("server_time", m.server_time, -max_real, max_real, Presence::defaulted);
  v.real("fps_hint", m.fps_hint, 0, 1000, Presence::defaulted);
  v.uint("batch_interval", m.batch_interval, 60000U, Presence::defaulted);
  v.reals("quantizers", m.quantizers, 66, 1e-06, 1000000.0, Presence::defaulted);
  v.boolean("recovered", m.recovered, Presence::defaulted);
  v.optional_real("viseme_share", m.viseme_share, 0, 1);
  v.optional("sound", m.sound, Presence::appended);
}

template <class M, class V>
  requires std::same_as<std::remove_const_t<M>, Keyframe>
void visit_fields(M& m, V& v) {
  v.uint("sequence", m.sequence, 9007199254740991U, Presence::defaulted);
  v.uint("media_time", m.media_time, 9007199254740991U, Presence::defaulted);
  v.state("state", m.state);
}

template <class M, class V>
  requires std::same_as<std::remove_const_t<M>, Frames>
void visit_fields(M& m, V& v) {
  v.uint("sequence", m.sequence, 9007199254740991U, Presence::defaulted);
  v.uint("media_time", m.media_time, 9007199254740991U, Presence::defaulted);
  v.frames("frames", m.frames);
}

template <class M, class V>
  requires std::same_as<std::remove_const_t<M>, End>
void visit_fields(M& m, V& v) {
  v.enumeration("reason", m.reason, end_reason_names, Presence::defaulted);
}

template <class M, class V>
  requires std::same_as<std::remove_const_t<M>, StreamError>
void visit_fields(M& m, V& v) {
  v.enumeration("code", m.code, stream_error_code_names, Presence::defaulted);
  v.text("where", m.where, 1024, Presence::defaulted);
  v.text("message", m.message, 4096, Presence::defaulted);
}

template <class M, class V>
  requires std::same_as<std::remove_const_t<M>, SoundPacket>
void visit_fields(M& m, V& v) {
  v.uint("media_time", m.media_time, 9007199254740991U, Presence::defaulted);
  v.bytes("packet", m.packet, 4000, Presence::required);
}

template <class M, class V>
  requires std::same_as<std::remove_const_t<M>, SpeechText>
void visit_fields(M& m, V& v) {
  v.uint("speech", m.speech, 9007199254740991U, Presence::required);
  v.uint("media_time", m.media_time, 9007199254740991U, Presence::defaulted);
  v.text("language", m.language, 64, Presence::defaulted);
  v.text("text", m.text, 2000, Presence::defaulted);
  v.bytes("score", m.score, 4000, Presence::required);
}

template <class M, class V>
  requires std::same_as<std::remove_const_t<M>, Spoken>
void visit_fields(M& m, V& v) {
  v.enumeration("state", m.state, voice_state_names, Presence::required);
  v.uint("speech", m.speech, 9007199254740991U, Presence::defaulted);
  v.uint("character", m.character, 2000U, Presence::defaulted);
  v.uint("media_time", m.media_time, 9007199254740991U, Presence::defaulted);
}

template <class M, class V>
  requires std::same_as<std::remove_const_t<M>, CaptionsWish>
void visit_fields(M& m, V& v) {
  v.boolean("on", m.on, Presence::required);
}

template <class M, class V>
  requires std::same_as<std::remove_const_t<M>, Ping>
void visit_fields(M& m, V& v) {
  v.uint("id", m.id, 4294967295U, Presence::defaulted);
  v.real("client_time", m.client_time, -max_real, max_real, Presence::defaulted);
}

template <class M, class V>
  requires std::same_as<std::remove_const_t<M>, Pong>
void visit_fields(M& m, V& v) {
  v.uint("id", m.id, 4294967295U, Presence::defaulted);
  v.real("client_time", m.client_time, -max_real, max_real, Presence::defaulted);
  v.real("server_time", m.server_time, -max_real, max_real, Presence::defaulted);
  v.uint("media_time", m.media_time, 9007199254740991U, Presence::defaulted);
}

}  // namespace semblante

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "clients/runtime/playout.h"
#include "clients/runtime/ring.h"
#include "clients/runtime/semblante.h"
#include "clients/runtime/times.h"
#include "protocol/cpp/messages.h"
#include "protocol/cpp/quantizers.h"

namespace semblante::runtime {

class Stream;

struct PlayerOptions {
  PlayoutOptions playout;
  std::size_t max_frames = 2048;
};

/// Where a player is: between two frames, on a line or a curve.
struct Moment {
  /// The frames before, from, to and after; a curve uses all four, a line the middle two.
  std::array<semblante_frame, 4> frames{};
  float t = 0;  ///< from `from` to `to`, 0..1
  bool is_curve = false;
  std::array<float, 3> spans{};                      ///< of a curve, as semblante_ease takes them
  std::optional<double> viseme_share;                ///< in place of the head's
  double from_time = 0, to_time = 0;                 ///< media times, ms
  std::uint64_t from_sequence = 0, to_sequence = 0;  ///< 0 without a stream
};

/// Frames in, the moment to show out: what semblante.h says of semblante_player. Times in ms.
class Player {
 public:
  explicit Player(const PlayerOptions& options);
  ~Player();
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  /// Null: nobody.
  void follow(Stream* stream);
  [[nodiscard]] const Stream* followed() const { return stream_; }

  /// A header was received; another epoch is another time line.
  void begin(const Header& header);
  /// Frames were received; those not after the newest known one are left out.
  void push(const Frames& frames, double now);
  /// The same without a stream: finite, by rising time.
  void push(std::span<const semblante_timed_frame> frames, double now);
  void clear();

  /// False while there is nothing to show.
  bool advance(double now, double elapsed);
  bool move_to(double media_time);

  /// Meaningless before the first frame.
  [[nodiscard]] const Moment& moment() const { return moment_; }
  [[nodiscard]] bool has_moment() const { return has_moment_; }
  [[nodiscard]] const Playout& playout() const { return playout_; }
  [[nodiscard]] std::size_t held() const { return held_.size(); }

 private:
  struct Held {
    double time = 0;
    double begin = 0;  ///< media time at which the motion towards it begins
    std::uint64_t sequence = 0;
    FaceFrame state;
  };
  void hold(double time, std::uint64_t sequence, const FaceFrame& state);
  void arrived(std::size_t before, double now);
  /// The moment at the playhead.
  void select();
  void choose_curve(double span);
  [[nodiscard]] semblante_frame in_units(const FaceFrame& state) const;
  /// The frames of the moment are read anew at the next step; until then it stays what is shown.
  void forget_moment() { is_moment_forgotten_ = true; }

  PlayerOptions options_;
  Playout playout_;
  Stream* stream_ = nullptr;
  QuantizerSteps steps_;
  Ring<Held, 16> held_;              ///< the first is the last one at or before the playhead
  std::optional<Held> before_;       ///< the one before the first, for curves
  double rested_at_ = unknown_time;  ///< time of the frame at which the last curve ended without velocity
  double last_advance_ = unknown_time;
  Moment moment_;
  bool has_moment_ = false;
  bool is_moment_forgotten_ = true;
};

}  // namespace semblante::runtime

#pragma once

#include <memory>
#include <optional>
#include <string>

#include "clients/native/render/gl_head.h"
#include "clients/native/render/gl_screen.h"
#include "clients/native/viewer/follower.h"
#include "clients/native/viewer/orbit.h"
#include "clients/native/viewer/pace.h"

namespace semblante::viewer {

enum class Quality { automatic, low, high };

struct ShowOptions {
  render::Subject subject = render::Subject::all;
  Quality quality = Quality::automatic;  ///< high: never cheaper, however slow; low: at once
};

/// The face of a stream in the OpenGL ES 3 context that is current on the thread that made it, which is also that of
/// all calls. `follower` must outlive the show.
class Show {
 public:
  /// Errors: those of GlScreen::create.
  static Result<std::unique_ptr<Show>> create(Follower& follower, const ShowOptions& options);

  /// Takes what there is to show now. True if the picture changes.
  Result<bool> update();
  /// Draws a picture of this size in pixels. `seconds`: since the one before.
  Status draw(int width, int height, double seconds);

  Orbit& orbit() { return orbit_; }
  /// The face is there and has the state of its stream.
  [[nodiscard]] bool is_showing() const { return head_ && shown_; }
  /// The line at the lower edge; empty while the face moves.
  [[nodiscard]] const std::string& words() const { return words_; }
  /// Name, level of detail and vertices, for a log; empty before the first face.
  [[nodiscard]] std::string face_name() const;
  [[nodiscard]] render::Picture read() const { return screen_.read(); }

 private:
  Show(Follower& follower, const ShowOptions& options, render::GlScreen screen);
  Status wear(LoadedFace&& loaded);

  Follower& follower_;
  ShowOptions options_;
  render::GlScreen screen_;
  Orbit orbit_;
  Pace pace_;
  std::optional<client::Face> face_;
  std::optional<render::GlHead> head_;
  std::optional<client::DisplayedFrame> shown_;
  std::shared_ptr<const Header> header_;
  std::string words_;
};

}  // namespace semblante::viewer

#pragma once

#include <memory>
#include <string>

#include "core/types/result.h"

namespace semblante::viewer {

struct WindowOptions {
  std::string title;
  int width = 720, height = 720;  ///< points of the screen
  bool fullscreen = false;
};

/// What a person did since the last look: with a mouse, one or two fingers, or keys.
struct Input {
  bool quits = false;
  bool looks_front = false;
  bool was_exposed = false;  ///< the window must be drawn again
  float turn_x = 0;          ///< of a drag, in window widths to the right, and heights down
  float turn_y = 0;
  float zoom = 1;  ///< factor of the distance
};

/// A window, or the whole screen, with an OpenGL ES 3 context that is current on the thread that opened it. Of SDL, so
/// also on a console without a desktop. One at a time.
class Window {
 public:
  /// Errors: unsupported, with SDL's reason.
  static Result<Window> open(const WindowOptions& options);
  ~Window();
  Window(Window&&) noexcept;
  Window& operator=(Window&&) noexcept;

  Input poll();
  /// Pixels, which may be more than points.
  [[nodiscard]] int width() const;
  [[nodiscard]] int height() const;
  /// Shows what was drawn; waits for the screen where the driver does so.
  void swap();
  void set_title(const std::string& title);

 private:
  struct Impl;
  explicit Window(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace semblante::viewer

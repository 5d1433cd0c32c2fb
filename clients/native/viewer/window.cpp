#include "clients/native/viewer/window.h"

#include <SDL.h>
#include <algorithm>
#include <cmath>
#include <utility>

namespace semblante::viewer {
namespace {

constexpr float key_turn = 0.05F;  // window widths for a press of an arrow
constexpr float zoom_step = 0.9F;

Error refused(const char* what) {
  return {ErrorCode::unsupported, "window", std::string(what) + ": " + SDL_GetError()};
}

}  // namespace

struct Window::Impl {
  SDL_Window* window = nullptr;
  SDL_GLContext context = nullptr;

  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    if (context != nullptr) SDL_GL_DeleteContext(context);
    if (window != nullptr) SDL_DestroyWindow(window);
    SDL_Quit();
  }

  void take_key(SDL_Keycode key, Input& input) const {
    switch (key) {
      case SDLK_ESCAPE:
      case SDLK_q:
        input.quits = true;
        break;
      case SDLK_LEFT:
        input.turn_x -= key_turn;
        break;
      case SDLK_RIGHT:
        input.turn_x += key_turn;
        break;
      case SDLK_UP:
        input.turn_y -= key_turn;
        break;
      case SDLK_DOWN:
        input.turn_y += key_turn;
        break;
      case SDLK_PLUS:
      case SDLK_EQUALS:
      case SDLK_KP_PLUS:
        input.zoom *= zoom_step;
        break;
      case SDLK_MINUS:
      case SDLK_KP_MINUS:
        input.zoom /= zoom_step;
        break;
      case SDLK_HOME:
        input.looks_front = true;
        break;
      case SDLK_f:
      case SDLK_F11: {
        const bool is_full = (SDL_GetWindowFlags(window) & SDL_WINDOW_FULLSCREEN) != 0;
        SDL_SetWindowFullscreen(window, is_full ? 0 : SDL_WINDOW_FULLSCREEN_DESKTOP);
        break;
      }
      default:
        break;
    }
  }
};

Window::Window(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Window::~Window() = default;
Window::Window(Window&&) noexcept = default;
Window& Window::operator=(Window&&) noexcept = default;

Result<Window> Window::open(const WindowOptions& options) {
  auto impl = std::make_unique<Impl>();
  SDL_SetHint(SDL_HINT_OPENGL_ES_DRIVER, "1");
  SDL_SetHint(SDL_HINT_VIDEO_ALLOW_SCREENSAVER, "0");
  if (SDL_Init(SDL_INIT_VIDEO) != 0) {
    return refused("there is no screen");
  }
  SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_ES);
  SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 3);
  SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 0);
  SDL_GL_SetAttribute(SDL_GL_DOUBLEBUFFER, 1);
  SDL_GL_SetAttribute(SDL_GL_DEPTH_SIZE, 0);  // the head is drawn elsewhere
  const Uint32 flags = SDL_WINDOW_OPENGL | SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI |
                       (options.fullscreen ? Uint32{SDL_WINDOW_FULLSCREEN_DESKTOP} : 0U);
  impl->window = SDL_CreateWindow(options.title.c_str(), SDL_WINDOWPOS_UNDEFINED, SDL_WINDOWPOS_UNDEFINED,
                                  options.width, options.height, flags);
  if (impl->window == nullptr) {
    return refused("the window cannot be opened");
  }
  impl->context = SDL_GL_CreateContext(impl->window);
  if (impl->context == nullptr) {
    return refused("the driver has no OpenGL ES 3");
  }
  SDL_GL_SetSwapInterval(1);  // a driver that cannot is drawn to without waiting
  if (options.fullscreen) {
    SDL_ShowCursor(SDL_DISABLE);
  }
  return Window(std::move(impl));
}

Input Window::poll() {
  Input input;
  int width = 1;
  int height = 1;
  SDL_GetWindowSize(impl_->window, &width, &height);
  SDL_Event event;
  while (SDL_PollEvent(&event) != 0) {
    switch (event.type) {
      case SDL_QUIT:  // also SIGINT and SIGTERM
        input.quits = true;
        break;
      case SDL_WINDOWEVENT:
        input.was_exposed = true;
        break;
      case SDL_MOUSEMOTION:  // a finger is one, too
        if ((event.motion.state & SDL_BUTTON_LMASK) != 0) {
          input.turn_x += static_cast<float>(event.motion.xrel) / static_cast<float>(std::max(width, 1));
          input.turn_y += static_cast<float>(event.motion.yrel) / static_cast<float>(std::max(height, 1));
        }
        break;
      case SDL_MOUSEBUTTONDOWN:
        input.looks_front = input.looks_front || event.button.clicks >= 2;
        break;
      case SDL_MOUSEWHEEL:
        input.zoom *= std::pow(zoom_step, event.wheel.preciseY);
        break;
      case SDL_MULTIGESTURE:
        input.zoom *= 1 - 2 * std::clamp(event.mgesture.dDist, -0.25F, 0.25F);
        break;
      case SDL_KEYDOWN:
        impl_->take_key(event.key.keysym.sym, input);
        break;
      default:
        break;
    }
  }
  return input;
}

int Window::width() const {
  int pixels = 1;
  SDL_GL_GetDrawableSize(impl_->window, &pixels, nullptr);
  return std::max(pixels, 1);
}

int Window::height() const {
  int pixels = 1;
  SDL_GL_GetDrawableSize(impl_->window, nullptr, &pixels);
  return std::max(pixels, 1);
}

void Window::swap() { SDL_GL_SwapWindow(impl_->window); }

void Window::set_title(const std::string& title) { SDL_SetWindowTitle(impl_->window, title.c_str()); }

}  // namespace semblante::viewer

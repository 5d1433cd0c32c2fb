// The viewer as an Android app: a NativeActivity, which needs no Java code. The system calls the functions below on its
// main thread; a thread of the app draws.

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include <EGL/egl.h>
#include <android/native_activity.h>

#include "clients/native/render/gl_screen.h"
#include "clients/native/viewer/address.h"
#include "clients/native/viewer/gestures.h"
#include "clients/native/viewer/show.h"

namespace semblante::viewer {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr std::chrono::milliseconds idle_step(8);
/// Radians for a drag over the whole window.
constexpr float turn_of_a_width = 3.2F;
/// Of the first level of detail.
constexpr std::uint32_t max_vertices = 20'000;
constexpr std::int32_t keep_screen_on = 0x80;  // AWINDOW_FLAG_KEEP_SCREEN_ON
constexpr const char* no_address = "Open the address of a stream's page, as in the studio's Live tab.";

/// The address by which the app was opened: Activity.getIntent().getDataString(). Empty: none.
std::string opened_address(ANativeActivity* activity) {
  JNIEnv* java = activity->env;
  std::string address;
  const auto call = [&](jobject object, const char* name, const char* type) -> jobject {
    if (object == nullptr) return nullptr;
    const jmethodID method = java->GetMethodID(java->GetObjectClass(object), name, type);
    return method == nullptr ? nullptr : java->CallObjectMethod(object, method);
  };
  java->PushLocalFrame(8);
  const jobject intent = call(activity->clazz, "getIntent", "()Landroid/content/Intent;");
  if (auto* const data = static_cast<jstring>(call(intent, "getDataString", "()Ljava/lang/String;"))) {
    if (const char* text = java->GetStringUTFChars(data, nullptr)) {
      address = text;
      java->ReleaseStringUTFChars(data, text);
    }
  }
  java->ExceptionClear();
  java->PopLocalFrame(nullptr);
  return address;
}

/// The follower of the stream at `address`. Errors: those of the address.
Result<std::unique_ptr<Follower>> follow(const std::string& address) {
  auto stream = parse_stream_address(address);
  if (!stream) return std::move(stream).error();
  auto url = client::parse_url(stream->server);
  if (!url) return std::move(url).error();
  // Of an invitation: the rest of the address after #token=.
  constexpr std::string_view mark = "#token=";
  client::ServerAddress server(*std::move(url));
  if (const std::size_t at = address.find(mark); at != std::string::npos)
    server.token = address.substr(at + mark.size());
  return std::make_unique<Follower>(std::move(server), stream->stream.empty() ? "demo" : stream->stream, "",
                                    max_vertices);
}

/// An OpenGL ES 3 context on a window, current on the thread that made it until it ends.
class Surface {
 public:
  explicit Surface(ANativeWindow* window) : display_(eglGetDisplay(EGL_DEFAULT_DISPLAY)) {
    eglInitialize(display_, nullptr, nullptr);
    // Depth and samples are of the framebuffer that the head is drawn to.
    const EGLint wish[] = {EGL_RENDERABLE_TYPE,
                           0x40 /* EGL_OPENGL_ES3_BIT */,
                           EGL_SURFACE_TYPE,
                           EGL_WINDOW_BIT,
                           EGL_RED_SIZE,
                           8,
                           EGL_GREEN_SIZE,
                           8,
                           EGL_BLUE_SIZE,
                           8,
                           EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    eglChooseConfig(display_, wish, &config, 1, &count);
    const EGLint version[] = {EGL_CONTEXT_CLIENT_VERSION, 3, EGL_NONE};
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, version);
    surface_ = eglCreateWindowSurface(display_, config, window, nullptr);
    is_current_ = eglMakeCurrent(display_, surface_, surface_, context_) == EGL_TRUE;
  }
  ~Surface() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (surface_ != EGL_NO_SURFACE) eglDestroySurface(display_, surface_);
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
  }
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;

  [[nodiscard]] bool is_current() const { return is_current_; }
  [[nodiscard]] int width() const { return size(EGL_WIDTH); }
  [[nodiscard]] int height() const { return size(EGL_HEIGHT); }
  /// Shows what was drawn; false when the window is gone.
  bool swap() { return eglSwapBuffers(display_, surface_) == EGL_TRUE; }

 private:
  [[nodiscard]] int size(EGLint which) const {
    EGLint pixels = 1;
    eglQuerySurface(display_, surface_, which, &pixels);
    return pixels;
  }
  EGLDisplay display_;
  EGLContext context_ = EGL_NO_CONTEXT;
  EGLSurface surface_ = EGL_NO_SURFACE;
  bool is_current_ = false;
};

/// The app while its activity lives. The stream is followed only while there is a window: an app that is not seen
/// neither loads nor draws.
class App {
 public:
  explicit App(ANativeActivity* activity) : activity_(activity) {}
  ~App() { lose_window(); }
  App(const App&) = delete;
  App& operator=(const App&) = delete;

  void take_window(ANativeWindow* window) {
    stops_ = false;
    thread_ = std::thread([this, window, address = opened_address(activity_)] { draw(window, address); });
  }
  /// Returns when nothing draws to the window any more.
  void lose_window() {
    stops_ = true;
    if (thread_.joinable()) thread_.join();
  }
  void take_input(AInputQueue* queue) {
    AInputQueue_attachLooper(queue, ALooper_forThread(), ALOOPER_POLL_CALLBACK, read_input, this);
    queue_ = queue;
  }
  void lose_input(AInputQueue* queue) {
    AInputQueue_detachLooper(queue);
    queue_ = nullptr;
  }

 private:
  static int read_input(int /*descriptor*/, int /*events*/, void* self) {
    auto& app = *static_cast<App*>(self);
    AInputEvent* event = nullptr;
    while (app.queue_ != nullptr && AInputQueue_getEvent(app.queue_, &event) >= 0) {
      if (AInputQueue_preDispatchEvent(app.queue_, event) != 0) continue;
      AInputQueue_finishEvent(app.queue_, event, app.take_event(event) ? 1 : 0);
    }
    return 1;
  }

  /// False for keys, such as Back, which the system then handles.
  bool take_event(const AInputEvent* event) {
    if (AInputEvent_getType(event) != AINPUT_EVENT_TYPE_MOTION) return false;
    const std::int32_t action = AMotionEvent_getAction(event);
    const std::int32_t kind = action & AMOTION_EVENT_ACTION_MASK;
    const bool one_goes = kind == AMOTION_EVENT_ACTION_POINTER_UP;
    const auto going = static_cast<std::size_t>((action & AMOTION_EVENT_ACTION_POINTER_INDEX_MASK) >>
                                                AMOTION_EVENT_ACTION_POINTER_INDEX_SHIFT);
    const bool all_go = kind == AMOTION_EVENT_ACTION_UP || kind == AMOTION_EVENT_ACTION_CANCEL;
    const std::size_t pointers = all_go ? 0 : AMotionEvent_getPointerCount(event);
    const std::lock_guard lock(mutex_);
    std::array<Gestures::Finger, 2> fingers;
    std::size_t count = 0;
    for (std::size_t i = 0; i < pointers && count < fingers.size(); ++i) {
      if (one_goes && i == going) continue;
      fingers[count++] = {AMotionEvent_getX(event, i) / width_, AMotionEvent_getY(event, i) / height_};
    }
    gestures_.touch(fingers, count, static_cast<double>(AMotionEvent_getEventTime(event)) * 1e-9);
    return true;
  }

  Gesture gesture(int width, int height) {
    const std::lock_guard lock(mutex_);
    width_ = static_cast<float>(width > 0 ? width : 1);
    height_ = static_cast<float>(height > 0 ? height : 1);
    return gestures_.take();
  }

  bool rest() const {
    std::this_thread::sleep_for(idle_step);
    return !stops_;
  }

  /// The thread of a window.
  void draw(ANativeWindow* window, const std::string& address) {
    Surface surface(window);
    if (!surface.is_current()) return;
    auto follower = follow(address);
    if (!follower) {
      say(surface, address.empty() ? no_address : "This is not the address of a stream: " + follower.error().message);
      return;
    }
    auto made = Show::create(**follower, {});
    if (!made) return;
    Show& show = **made;
    Clock::time_point drawn = Clock::now();
    int width = 0;
    int height = 0;
    do {
      const bool was_resized = surface.width() != width || surface.height() != height;
      width = surface.width();
      height = surface.height();
      const Gesture did = gesture(width, height);
      if (did.looks_front) show.orbit().reset();
      show.orbit().turn(-turn_of_a_width * did.turn_x, turn_of_a_width * did.turn_y);
      show.orbit().zoom(did.zoom);
      const bool was_touched = did.looks_front || did.turn_x != 0 || did.turn_y != 0 || did.zoom != 1;
      const auto changes = show.update();
      if (!changes) return;
      if (!*changes && !was_touched && !was_resized) continue;
      const Clock::time_point now = Clock::now();
      if (!show.draw(width, height, Seconds(now - drawn).count()) || !surface.swap()) return;
      drawn = now;
    } while (rest());
  }

  /// Words alone, until the window goes.
  void say(Surface& surface, const std::string& words) const {
    auto screen = render::GlScreen::create();
    if (!screen) return;
    do {
      if (!screen->draw(nullptr, {}, surface.width(), surface.height(), 1, words) || !surface.swap()) return;
    } while (rest());
  }

  ANativeActivity* activity_;
  AInputQueue* queue_ = nullptr;
  std::thread thread_;
  std::atomic<bool> stops_ = false;
  std::mutex mutex_;
  Gestures gestures_;
  float width_ = 1, height_ = 1;
};

App& app_of(ANativeActivity* activity) { return *static_cast<App*>(activity->instance); }

}  // namespace
}  // namespace semblante::viewer

/// Called by the system, by this name, when it has loaded the library.
extern "C" __attribute__((visibility("default"))) void ANativeActivity_onCreate(ANativeActivity* activity,
                                                                                void* /*state*/, std::size_t /*size*/) {
  using namespace semblante::viewer;
  activity->instance = new App(activity);
  ANativeActivity_setWindowFlags(activity, keep_screen_on, 0);
  ANativeActivityCallbacks& on = *activity->callbacks;
  on.onDestroy = [](ANativeActivity* a) { delete &app_of(a); };
  on.onNativeWindowCreated = [](ANativeActivity* a, ANativeWindow* window) { app_of(a).take_window(window); };
  on.onNativeWindowDestroyed = [](ANativeActivity* a, ANativeWindow*) { app_of(a).lose_window(); };
  on.onInputQueueCreated = [](ANativeActivity* a, AInputQueue* queue) { app_of(a).take_input(queue); };
  on.onInputQueueDestroyed = [](ANativeActivity* a, AInputQueue* queue) { app_of(a).lose_input(queue); };
}

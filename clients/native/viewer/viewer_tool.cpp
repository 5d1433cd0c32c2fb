// semblante-viewer: the face of a stream in a window or on the whole screen.

#include <chrono>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include <CLI/CLI.hpp>

#include "clients/native/render/picture.h"
#include "clients/native/tools/run_tool.h"
#include "clients/native/tools/shots.h"
#include "clients/native/viewer/address.h"
#include "clients/native/viewer/show.h"
#include "clients/native/viewer/window.h"

namespace semblante::viewer {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// Where the driver does not wait for the screen.
constexpr std::chrono::milliseconds shortest_picture(7);
constexpr std::chrono::milliseconds idle_step(8);
/// Radians for a drag over the whole window.
constexpr float turn_of_a_width = 3.2F;

struct Arguments {
  client::ServerOptions server;
  std::string stream, model;
  std::uint32_t max_vertices = 20'000;
  std::string quality = "auto";
  std::string subject = "all";
  std::string size = "720x720";
  bool fullscreen = false;
  std::filesystem::path picture;
  double after = 0;
};

Quality quality_of(std::string_view name) {
  return name == "high" ? Quality::high : name == "low" ? Quality::low : Quality::automatic;
}

/// Says on standard output what changed, for the journal of a device without a keyboard.
class Log {
 public:
  void tell(const Show& show) {
    tell(words_, show.words());
    tell(face_, show.face_name());
    tell(motion_, show.is_showing() && show.words().empty() ? "showing" : "");
  }

 private:
  static void tell(std::string& before, const std::string& now) {
    if (now == before) return;
    before = now;
    if (!now.empty()) std::cout << now << std::endl;
  }
  std::string words_, face_, motion_;
};

Status run(Arguments arguments) {
  auto address = parse_stream_address(arguments.server.address);
  if (!address) {
    return std::move(address).error();
  }
  arguments.server.address = address->server;
  if (arguments.stream.empty()) {
    arguments.stream = address->stream.empty() ? "demo" : address->stream;
  }
  auto server = arguments.server.parse();
  if (!server) {
    return std::move(server).error();
  }
  const auto size = tools::parse_size(arguments.size);
  if (!size) {
    return size.error();
  }
  const auto subject = render::parse_subject(arguments.subject);
  if (!subject) {
    return Error{ErrorCode::invalid_argument, "--subject", "must be all, face, eyes or mouth"};
  }
  auto window = Window::open({"Semblante: " + arguments.stream, size->width, size->height, arguments.fullscreen});
  if (!window) {
    return std::move(window).error();
  }
  Follower follower(*std::move(server), arguments.stream, arguments.model, arguments.max_vertices);
  auto made = Show::create(follower, {*subject, quality_of(arguments.quality)});
  if (!made) {
    return std::move(made).error();
  }
  Show& show = **made;
  Log log;
  Clock::time_point drawn = Clock::now();
  std::optional<Clock::time_point> first_shown;
  bool is_dirty = true;
  while (true) {
    const Input input = window->poll();
    if (input.quits) {
      return Unit{};
    }
    if (input.looks_front) show.orbit().reset();
    show.orbit().turn(-turn_of_a_width * input.turn_x, turn_of_a_width * input.turn_y);
    show.orbit().zoom(input.zoom);
    is_dirty =
        is_dirty || input.was_exposed || input.looks_front || input.turn_x != 0 || input.turn_y != 0 || input.zoom != 1;
    auto changes = show.update();
    if (!changes) {
      return std::move(changes).error();
    }
    log.tell(show);
    const bool is_due = show.is_showing() && !arguments.picture.empty() &&
                        Clock::now() - first_shown.value_or(Clock::now()) >= Seconds(arguments.after);
    if (show.is_showing() && !first_shown) {
      first_shown = Clock::now();
    }
    if (!is_dirty && !*changes && !is_due) {
      std::this_thread::sleep_for(idle_step);
      continue;
    }
    is_dirty = false;
    const Clock::time_point now = Clock::now();
    const double seconds = Seconds(now - drawn).count();
    drawn = now;
    if (auto done = show.draw(window->width(), window->height(), seconds); !done) {
      return done;
    }
    if (is_due) {
      return render::write_png(show.read(), arguments.picture);
    }
    window->swap();
    std::this_thread::sleep_until(now + shortest_picture);
  }
}

}  // namespace
}  // namespace semblante::viewer

// Only a mistake in the options themselves throws outside a try: it may end the program.
int main(int argc, char** argv) {  // NOLINT(bugprone-exception-escape)
  semblante::viewer::Arguments arguments;
  CLI::App app{
      "Shows the face of a stream. A drag or one finger turns it, the wheel or two fingers zoom, a double click looks "
      "at the front; F: full screen, Q: end.",
      "semblante-viewer"};
  app.add_option("url", arguments.server.address,
                 "ws://HOST:PORT/v1/streams/STREAM, http://HOST:PORT/view/STREAM, or the server alone; wss, https "
                 "likewise")
      ->required();
  semblante::client::declare_access_options(app, arguments.server);
  app.add_option("-s,--stream", arguments.stream, "id of the stream, if the address names none; default: demo");
  app.add_option("-m,--model", arguments.model, "id of the model; default: the one the stream suggests");
  app.add_flag("--fullscreen", arguments.fullscreen, "use the whole screen");
  app.add_option("--size", arguments.size, "size of the window")->capture_default_str();
  app.add_option("--subject", arguments.subject, "what fills the window: all, face, eyes, mouth")
      ->capture_default_str();
  app.add_option("--max-vertices", arguments.max_vertices,
                 "begin with the level of detail with at most this many vertices")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--quality", arguments.quality,
                 "auto: cheaper when less than 30 pictures a second are drawn; high: never; low: at once")
      ->check(CLI::IsMember({"auto", "low", "high"}))
      ->capture_default_str();
  app.add_option("--picture", arguments.picture, "write the window as this PNG file and end");
  app.add_option("--after", arguments.after, "seconds from the first picture of the face to --picture")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  return semblante::tools::run_tool(app, argc, argv, [&] { return semblante::viewer::run(arguments); });
}

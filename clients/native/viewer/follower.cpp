#include "clients/native/viewer/follower.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "clients/native/client/live_player.h"

namespace semblante::viewer {
namespace {

using std::chrono::milliseconds;

/// Between two looks at the player: a fraction of the time between two pictures.
constexpr milliseconds step(4);
/// Of a connection, and of a request: how long a program that is told to end may still take.
constexpr milliseconds connect_patience(3000);
constexpr milliseconds request_patience(20'000);
constexpr milliseconds first_pause(500);
constexpr milliseconds longest_pause(8000);

/// `error`, as a person in front of the window wants it said.
std::string words_of(const Error& error, const std::string& stream) {
  switch (error.code) {
    case ErrorCode::missing:
      return "There is no stream \"" + stream + "\" on this server.";
    case ErrorCode::invalid_argument:
      return "This stream is private: start the viewer with --token.";
    case ErrorCode::mismatch:
      return "The server speaks another version of the protocol.";
    default:
      return "The server cannot be reached. Trying again.";
  }
}

std::string words_of_face(const Error& error) {
  switch (error.code) {
    case ErrorCode::missing:
      return "This face is still being prepared.";
    case ErrorCode::io:
      return "The face cannot be loaded yet. Trying again.";
    default:
      return "This face could not be loaded: " + error.message;
  }
}

}  // namespace

Follower::Follower(client::ServerAddress server, std::string stream, std::string model, std::uint32_t max_vertices)
    : server_(std::move(server)),
      stream_(std::move(stream)),
      chosen_model_(std::move(model)),
      max_vertices_(max_vertices) {
  now_.words = "Connecting to " + server_.url.host;
  stream_thread_ = std::thread([this] { follow(); });
  load_thread_ = std::thread([this] { load(); });
}

Follower::~Follower() {
  {
    const std::lock_guard lock(mutex_);
    stops_ = true;
  }
  changed_.notify_all();
  stream_thread_.join();
  load_thread_.join();
}

Now Follower::now() const {
  const std::lock_guard lock(mutex_);
  Now now = now_;
  if (now.words.empty()) {
    now.words = loading_words_;
  }
  return now;
}

std::unique_ptr<LoadedFace> Follower::take_face() {
  const std::lock_guard lock(mutex_);
  return std::move(loaded_);
}

void Follower::load_level(std::uint32_t lod) {
  {
    const std::lock_guard lock(mutex_);
    wish_.level = {.lod = lod, .max_vertices = std::nullopt};
  }
  changed_.notify_all();
}

bool Follower::pause(milliseconds time) {
  std::unique_lock lock(mutex_);
  return !changed_.wait_for(lock, time, [this] { return stops_; });
}

void Follower::say(std::string words) {
  const std::lock_guard lock(mutex_);
  now_.words = std::move(words);
}

void Follower::follow() {
  milliseconds wait = first_pause;
  do {
    const auto begun = std::chrono::steady_clock::now();
    if (auto done = follow_once(); !done) {
      say(words_of(done.error(), stream_));
    }
    const bool was_good = std::chrono::steady_clock::now() - begun > longest_pause;
    wait = was_good ? first_pause : std::min(2 * wait, longest_pause);
  } while (pause(wait));
}

Status Follower::follow_once() {
  client::LiveStreamOptions options;
  options.socket.timeout = connect_patience;
  options.longest_pause = longest_pause;
  client::LivePlayer player(server_, stream_, options);
  const client::LiveStream& stream = player.stream();
  std::uint64_t epoch = 0;
  std::string model;
  while (true) {
    if (auto received = player.receive(step); !received) {
      return received;
    }
    if (stream.ended()) {
      say("The stream has ended.");
      return Unit{};
    }
    const auto frame = player.show();
    const std::optional<Header>& header = stream.header();
    const std::lock_guard lock(mutex_);
    if (stops_) {
      return Unit{};
    }
    if (header && (!now_.header || header->epoch != epoch || header->model != model)) {
      epoch = header->epoch;
      model = header->model;
      now_.header = std::make_shared<const Header>(*header);
      const std::string& worn = chosen_model_.empty() ? model : chosen_model_;
      if (worn != wish_.model) {
        wish_ = {worn, {.lod = std::nullopt, .max_vertices = max_vertices_}};
        changed_.notify_all();
      }
    }
    if (frame) {
      now_.frame = frame;
    }
    if (stream.loss()) {
      now_.words = now_.header ? "The connection was lost. Trying again." : words_of(*stream.loss(), stream_);
    } else if (stream.connected()) {
      now_.words = wish_.model.empty() ? "The stream \"" + stream_ + "\" has no face yet." : "";
    }
  }
}

void Follower::load() {
  milliseconds wait = first_pause;
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stops_ || (!wish_.model.empty() && wish_ != fulfilled_); });
    if (stops_) {
      return;
    }
    const Wish wish = wish_;
    const std::shared_ptr<const Header> header = now_.header;
    if (!fulfilled_ || fulfilled_->model != wish.model) {
      loading_words_ = "Loading the face";
    }
    lock.unlock();
    auto loaded = load_once(wish);
    lock.lock();
    if (loaded) {
      loaded_ = *std::move(loaded);
      fulfilled_ = wish;
      loading_words_.clear();
      wait = first_pause;
      continue;
    }
    loading_words_ = words_of_face(loaded.error());
    changed_.wait_for(lock, wait, [&] { return stops_ || wish_ != wish; });
    wait = std::min(2 * wait, longest_pause);
  }
}

Result<std::unique_ptr<LoadedFace>> Follower::load_once(const Wish& wish) const {
  client::HttpLimits limits;
  limits.timeout = request_patience;
  const client::HttpClient http(server_, limits);
  auto face = client::load_face(http, wish.model, wish.level);
  if (!face) {
    return std::move(face).error();
  }
  // Without an image the plain colour stays.
  static_cast<void>(client::fetch_images(http, *face));
  const FeaturePointSet points = face->feature_points();
  auto scene = render::build_scene(face->model(), {.points = points, .role_of_vertex = face->roles()});
  if (!scene) {
    return std::move(scene).error();
  }
  return std::unique_ptr<LoadedFace>(new LoadedFace{*std::move(face), *std::move(scene)});
}

}  // namespace semblante::viewer

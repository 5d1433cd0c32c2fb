#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "clients/native/client/face_package.h"
#include "clients/native/client/frame_player.h"
#include "clients/native/render/scene.h"
#include "protocol/cpp/messages.h"
#include "protocol/http/server_address.h"

namespace semblante::viewer {

/// A face as it was loaded, and laid out for drawing.
struct LoadedFace {
  client::Face face;
  render::Scene scene;
};

/// What a window shows of a stream now.
struct Now {
  std::optional<client::DisplayedFrame> frame;  ///< of the newest known state; stays while the connection is lost
  std::shared_ptr<const Header> header;         ///< null before the first
  std::string words;                            ///< what keeps the face from moving; empty while nothing does
};

/// Follows a stream and loads its faces on threads of its own, so that a window never waits for the network. It tries
/// again after every failure: a server that is not there yet, a stream that ended, a face that is still prepared.
class Follower {
 public:
  /// `model`: worn instead of the stream's own; empty: the stream's. `max_vertices`: of the first level of detail.
  Follower(client::ServerAddress server, std::string stream, std::string model, std::uint32_t max_vertices);
  ~Follower();
  Follower(const Follower&) = delete;
  Follower& operator=(const Follower&) = delete;

  [[nodiscard]] Now now() const;
  /// A face that was loaded since the last call; null otherwise.
  std::unique_ptr<LoadedFace> take_face();
  /// Asks for another level of detail of the same face, which take_face() gives later.
  void load_level(std::uint32_t lod);

 private:
  struct Wish {
    std::string model;
    client::LevelChoice level;
    bool operator==(const Wish& other) const {
      return model == other.model && level.lod == other.level.lod && level.max_vertices == other.level.max_vertices;
    }
  };
  void follow();
  /// One subscription, until it cannot go on. The error is for display.
  Status follow_once();
  void load();
  Result<std::unique_ptr<LoadedFace>> load_once(const Wish& wish) const;
  /// False when the follower ends.
  bool pause(std::chrono::milliseconds time);
  void say(std::string words);

  client::ServerAddress server_;
  std::string stream_, chosen_model_;
  std::uint32_t max_vertices_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool stops_ = false;
  Now now_;
  std::string loading_words_;
  Wish wish_;                      ///< model empty: none
  std::optional<Wish> fulfilled_;  ///< by the face that was loaded last
  std::unique_ptr<LoadedFace> loaded_;

  std::thread stream_thread_, load_thread_;
};

}  // namespace semblante::viewer

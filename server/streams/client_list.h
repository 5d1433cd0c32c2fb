#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <memory>
#include <vector>

#include "server/streams/stream_peer.h"

namespace semblante::streams {

/// All connections of a stream, from before their hello until their socket is gone. Keeps them alive, those that leave
/// during a slice until it is over: the slice uses their sockets. Not synchronized.
class ClientList {
 public:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] std::size_t size() const { return clients_.size(); }
  [[nodiscard]] const std::vector<std::shared_ptr<StreamPeer>>& all() const { return clients_; }

  void add(std::shared_ptr<StreamPeer> client, Clock::time_point now);
  /// Nothing when it is not in the list. The caller lets go of what is returned without the stream's mutex, because
  /// that may be the end of the connection.
  std::shared_ptr<StreamPeer> remove(StreamPeer& client);

  void begin_slice() { in_slice_ = true; }
  /// Those that left meanwhile; see remove().
  std::vector<std::shared_ptr<StreamPeer>> end_slice();

  /// Those that were added `patience` ago or earlier and have not said hello; each is returned once.
  std::vector<std::shared_ptr<StreamPeer>> silent(std::chrono::milliseconds patience, Clock::time_point now);

 private:
  struct Newcomer {
    std::weak_ptr<StreamPeer> client;
    Clock::time_point came;
  };
  std::vector<std::shared_ptr<StreamPeer>> clients_;
  std::deque<Newcomer> newcomers_;  ///< oldest first
  bool in_slice_ = false;
  std::vector<std::shared_ptr<StreamPeer>> left_;  ///< during the slice
};

}  // namespace semblante::streams

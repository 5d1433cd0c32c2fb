#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <memory>
#include <vector>

#include "server/streams/stream_peer.h"

namespace semblante::streams {

/// All connections of a stream, from before their hello until their socket is closed. Owns them; those that leave
/// during a slice are kept until its end, because the slice uses their sockets. Not synchronized.
class ClientList {
 public:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] std::size_t size() const { return clients_.size(); }
  [[nodiscard]] const std::vector<std::shared_ptr<StreamPeer>>& all() const { return clients_; }

  void add(std::shared_ptr<StreamPeer> client, Clock::time_point now);
  /// Null when it is not in the list. The caller must release the result without the stream's mutex, because that may
  /// destroy the connection.
  std::shared_ptr<StreamPeer> remove(StreamPeer& client);

  void begin_slice() { in_slice_ = true; }
  /// The connections removed during the slice; see remove().
  std::vector<std::shared_ptr<StreamPeer>> end_slice();

  /// Connections added `patience` ago or earlier that have not sent a hello; each is returned once.
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

#include "server/streams/client_list.h"

#include <utility>

namespace semblante::streams {

void ClientList::add(std::shared_ptr<StreamPeer> client, Clock::time_point now) {
  client->notes().client = clients_.size();
  newcomers_.push_back({client, now});
  clients_.push_back(std::move(client));
}

std::shared_ptr<StreamPeer> ClientList::remove(StreamPeer& client) {
  const auto index = std::exchange(client.notes().client, StreamPeer::nowhere);
  if (index == StreamPeer::nowhere) return nullptr;
  auto removed = std::move(clients_[index]);
  if (index + 1 != clients_.size()) {
    clients_[index] = std::move(clients_.back());
    clients_[index]->notes().client = index;
  }
  clients_.pop_back();
  if (!in_slice_) return removed;
  left_.push_back(std::move(removed));
  return nullptr;
}

std::vector<std::shared_ptr<StreamPeer>> ClientList::end_slice() {
  in_slice_ = false;
  return std::exchange(left_, {});
}

std::vector<std::shared_ptr<StreamPeer>> ClientList::silent(std::chrono::milliseconds patience, Clock::time_point now) {
  std::vector<std::shared_ptr<StreamPeer>> silent;
  while (!newcomers_.empty()) {
    auto client = newcomers_.front().client.lock();
    if (client && now - newcomers_.front().came <= patience) break;
    newcomers_.pop_front();
    if (client && !client->notes().said_hello) silent.push_back(std::move(client));
  }
  return silent;
}

}  // namespace semblante::streams

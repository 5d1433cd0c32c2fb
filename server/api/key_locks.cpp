#include "server/api/key_locks.h"

namespace semblante::api {

std::optional<KeyLocks::Held> KeyLocks::acquire(std::string_view key, std::chrono::milliseconds limit) {
  std::unique_lock guard(mutex_);
  const auto lock = locks_.try_emplace(std::string(key)).first;
  ++lock->second.users;
  if (lock->second.released.wait_for(guard, limit, [&] { return !lock->second.held; })) {
    lock->second.held = true;
    return Held(*this, lock);
  }
  if (--lock->second.users == 0) locks_.erase(lock);
  return std::nullopt;
}

KeyLocks::Held::~Held() {
  if (owner_ == nullptr) return;
  const std::lock_guard guard(owner_->mutex_);
  lock_->second.held = false;
  if (--lock_->second.users == 0)
    owner_->locks_.erase(lock_);
  else
    lock_->second.released.notify_one();
}

std::size_t KeyLocks::size() const {
  const std::lock_guard guard(mutex_);
  return locks_.size();
}

}  // namespace semblante::api

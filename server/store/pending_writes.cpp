#include "server/store/pending_writes.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "server/log/guard.h"
#include "server/log/log.h"

namespace semblante::store {
namespace {

constexpr std::size_t most_named = 5;

}  // namespace

PendingWrites::PendingWrites(Options options)
    : options_(std::move(options)), thread_([this] { log::keep_running("the pending writes", [this] { run(); }); }) {}

PendingWrites::~PendingWrites() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

bool PendingWrites::is_ready(const Item& item) const {
  return !item.busy && std::none_of(items_.begin(), items_.end(), [&](const Item& other) {
    return other.number < item.number && other.resource == item.resource;
  });
}

bool PendingWrites::write(const void* owner, std::string resource, std::string what, Write write) {
  Lock lock(mutex_);
  items_.push_back({owner, std::move(resource), std::move(what), std::move(write), next_number_++});
  const auto item = std::prev(items_.end());
  return is_ready(*item) && attempt(lock, item);
}

bool PendingWrites::attempt(Lock& lock, std::list<Item>::iterator item) {
  item->busy = true;
  lock.unlock();
  try {
    with_reserve(item->write);
    lock.lock();
  } catch (const std::exception& fault) {
    lock.lock();
    item->busy = false;
    note(lock, fault);
    return false;
  }
  items_.erase(item);
  if (fault_) ++recorded_;
  changed_.notify_all();
  return true;
}

void PendingWrites::attempt_all(Lock& lock, const void* owner) {
  // Items are found by number, because the list may change while one is tried.
  std::uint64_t last = 0;
  while (true) {
    const auto item = std::find_if(items_.begin(), items_.end(), [&](const Item& i) {
      return i.number > last && (owner == nullptr || i.owner == owner) && is_ready(i);
    });
    if (item == items_.end()) return;
    last = item->number;
    attempt(lock, item);
  }
}

void PendingWrites::release(const void* owner) {
  Lock lock(mutex_);
  const auto is_busy = [&] {
    return std::any_of(items_.begin(), items_.end(), [&](const Item& i) { return i.owner == owner && i.busy; });
  };
  changed_.wait(lock, [&] { return !is_busy(); });
  attempt_all(lock, owner);
  changed_.wait(lock, [&] { return !is_busy(); });
  const auto left = std::erase_if(items_, [&](const Item& item) { return item.owner == owner; });
  if (left > 0)
    log::warning(std::to_string(left) + " changes could not be recorded; the next start finds what they were for");
}

void PendingWrites::note(const std::exception& fault) {
  const Lock lock(mutex_);
  note(lock, fault);
}

void PendingWrites::note(const Lock&, const std::exception& fault) {
  const bool disk_full = dynamic_cast<const DiskFull*>(&fault) != nullptr;
  if (!fault_ || fault_->disk_full != disk_full) {
    if (!fault_) recorded_ = 0;
    log::warning(std::string(disk_full ? "the disk is full" : "the data folder cannot be written") +
                 ", what must be recorded is kept and tried again: " + fault.what());
    fault_ = Fault{disk_full, fault.what()};
  }
  changed_.notify_all();
}

bool PendingWrites::release_reserve(const DiskFull& fault) {
  if (options_.reserve == nullptr || !options_.reserve->release()) return false;
  note(fault);
  return true;
}

void PendingWrites::probe(Lock& lock) {
  lock.unlock();
  try {
    if (options_.probe) options_.probe();
    if (options_.reserve != nullptr) options_.reserve->fill();
    lock.lock();
  } catch (const std::exception& fault) {
    lock.lock();
    note(lock, fault);
    return;
  }
  if (!items_.empty()) return;
  fault_.reset();
  log::info("the data folder can be written again; " + std::to_string(recorded_) + " pending changes are recorded");
}

void PendingWrites::run() {
  Lock lock(mutex_);
  auto delay = options_.first_delay;
  while (true) {
    if (!fault_ && !stopping_) delay = options_.first_delay;
    changed_.wait(lock, [this] {
      return stopping_ || fault_ ||
             std::any_of(items_.begin(), items_.end(), [this](const Item& item) { return is_ready(item); });
    });
    if (fault_) changed_.wait_for(lock, delay, [this] { return stopping_; });
    if (stopping_) return;
    const auto before = recorded_;
    attempt_all(lock, nullptr);
    if (fault_ && items_.empty()) probe(lock);
    delay = recorded_ != before ? options_.first_delay : std::min(2 * delay, options_.longest_delay);
  }
}

PendingStatus PendingWrites::status() const {
  const std::lock_guard lock(mutex_);
  PendingStatus status;
  status.writable = !fault_;
  status.disk_full = fault_ && fault_->disk_full;
  if (!fault_) return status;  // without a fault, all items of the list are in their first attempt
  status.count = items_.size();
  for (const auto& item : items_) {
    if (status.what.size() == most_named) break;
    status.what.push_back(item.what);
  }
  return status;
}

}  // namespace semblante::store

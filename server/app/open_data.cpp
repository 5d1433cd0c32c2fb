#include "server/app/open_data.h"

#include <chrono>
#include <string>
#include <thread>

#include "server/app/serve_failure.h"
#include "server/store/data_files.h"
#include "server/store/sqlite_store.h"

namespace semblante {
namespace {
constexpr std::chrono::seconds lock_patience{5};
}  // namespace

std::unique_ptr<upkeep::DataLock> lock_data(const std::filesystem::path& data) {
  const auto deadline = std::chrono::steady_clock::now() + lock_patience;
  while (true) {
    auto lock = upkeep::DataLock::take(data);
    if (lock) return std::move(*lock);
    if (lock.error().code == ErrorCode::io)
      fail_serve("--data: the lock of the folder cannot be taken: " + lock.error().message);
    if (std::chrono::steady_clock::now() > deadline)
      fail_serve("--data: another server works in " + data.string() + "; stop it or choose another folder");
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

std::unique_ptr<store::Store> open_store(const std::filesystem::path& data, store::DiskReserve& reserve) {
  const auto open = [&] {
    auto store = store::open_sqlite_store(data / store::database_file_name);
    if (!store) fail("serve: --data", store.error());
    return std::move(*store);
  };
  try {
    try {
      return open();
    } catch (const store::DiskFull&) {
      if (!reserve.release()) throw;
    }
    return open();
  } catch (const store::DiskFull& fault) {
    throw CommandFailure(CommandFailure::internal, std::string("serve: --data: the disk is full: ") + fault.what());
  }
}

void check_writable(store::DatabaseFacts& store, const std::filesystem::path& data) {
  constexpr std::uint64_t least_free = std::uint64_t{1} << 20U;
  store.check_writable();
  constexpr std::uint64_t least_files = 16;  // of a job: its folder and what it makes
  if (store::free_bytes(data) < least_free) throw store::DiskFull("less than 1 MiB is free in " + data.string());
  if (store::free_files(data) < least_files) throw store::DiskFull("no more files can be made in " + data.string());
}

void make_folders(store::PendingWrites& pending, store::BlobStore& blobs, store::DiskReserve& reserve) {
  try {
    reserve.fill();
  } catch (const store::StoreError& fault) {
    pending.note(fault);
  }
  pending.write(&blobs, "folders", "the folders for uploads and blobs", [&blobs] { blobs.make_folders(); });
}

}  // namespace semblante

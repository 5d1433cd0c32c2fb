#pragma once

#include <filesystem>
#include <memory>

#include "server/store/blob_store.h"
#include "server/store/disk_space.h"
#include "server/store/pending_writes.h"
#include "server/store/store.h"
#include "server/upkeep/data_lock.h"

namespace semblante {

/// Refuses a second server on one data folder, because they would undo each other's changes. Retries for a short time:
/// a worker just started by a killed server holds the lock until the kernel has killed it. Throws CommandFailure.
std::unique_ptr<upkeep::DataLock> lock_data(const std::filesystem::path& data);

/// The store of a data folder, on a full disk with the reserve released. Throws CommandFailure: a new one cannot be
/// made on a full disk.
std::unique_ptr<store::Store> open_store(const std::filesystem::path& data, store::DiskReserve& reserve);

/// Throws StoreError unless a change can be made durable, and some disk space and some files are free: the store alone
/// may have space left in its own files.
void check_writable(store::DatabaseFacts& store, const std::filesystem::path& data);

/// On a full disk the folders are made later, when there is space; where a file has their name, when it is gone.
void make_folders(store::PendingWrites& pending, store::BlobStore& blobs, store::DiskReserve& reserve);

}  // namespace semblante

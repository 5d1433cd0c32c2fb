#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace semblante::store {

/// The data folder could not be read or written: nothing was changed, and the same call may succeed later. what() is
/// for the log, never for clients.
class StoreError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The disk is full, or a quota is used up.
class DiskFull : public StoreError {
 public:
  using StoreError::StoreError;
};

/// SQLite finds the database file damaged. It stays so until the file is restored.
class DamagedDatabase : public StoreError {
 public:
  using StoreError::StoreError;
};

/// The database was locked by another program until the wait for it timed out.
class BusyDatabase : public StoreError {
 public:
  using StoreError::StoreError;
};

/// The disk has less free than a job needs for its files; small writes may succeed.
class NotEnoughRoom : public DiskFull {
 public:
  using DiskFull::DiskFull;
};

/// Why a file could not be opened, read or written: the words of this errno, or what is in the place of the
/// file or folder (a FIFO, a device, a link), if that is the reason.
std::string reason_of(const std::filesystem::path& path, int error_number);
/// Whether this errno means that the disk or a quota is full.
bool is_disk_full(int error_number);
/// Throws DiskFull if this errno means it.
void throw_if_disk_full(const std::filesystem::path& path, int error_number);
/// Throws DiskFull if this errno means it, else StoreError.
[[noreturn]] void throw_store_error(const std::filesystem::path& path, int error_number);

}  // namespace semblante::store

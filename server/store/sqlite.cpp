#include "server/store/sqlite.h"

#include <cerrno>
#include <cmath>
#include <filesystem>
#include <system_error>

#include <nlohmann/json.hpp>

#include "server/store/store_error.h"

namespace semblante::store {
namespace {

/// SQLite's result codes distinguish faults of the disk (StoreError: a retry may succeed) from faults of this program.
[[noreturn]] void fail(sqlite3* handle, std::string_view what) {
  const std::string message = std::string(what) + ": " + (handle != nullptr ? sqlite3_errmsg(handle) : "out of memory");
  const int extended = handle != nullptr ? sqlite3_extended_errcode(handle) : SQLITE_NOMEM;
  // The growth of a shared-memory file fails without an errno.
  if (extended == SQLITE_IOERR_SHMSIZE || (handle != nullptr && is_disk_full(sqlite3_system_errno(handle)) &&
                                           ((extended & 0xFF) == SQLITE_IOERR || (extended & 0xFF) == SQLITE_CANTOPEN)))
    throw DiskFull(message);
  switch (extended & 0xFF) {
    case SQLITE_FULL:
      throw DiskFull(message);
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      throw DamagedDatabase(message);
    case SQLITE_BUSY:
      throw BusyDatabase(message);
    case SQLITE_IOERR:
    case SQLITE_READONLY:
    case SQLITE_CANTOPEN:
    case SQLITE_LOCKED:
    case SQLITE_PERM:
    case SQLITE_NOMEM:
      throw StoreError(message);
    default:
      throw std::runtime_error(message);
  }
}

/// A file: URI, in which some characters mean something.
std::string immutable_uri(const std::string& file) {
  std::string uri = "file:";
  for (const char c : file) {
    if (c == '%' || c == '?' || c == '#') {
      uri.append(c == '%' ? "%25" : c == '?' ? "%3f" : "%23");
    } else {
      uri.push_back(c);
    }
  }
  return uri + "?immutable=1";
}

/// SQLite opens what is there, and waits for a FIFO or reads a device. Throws StoreError.
void expect_files(const std::string& file) {
  for (const auto* end : {"", "-wal", "-shm"}) {
    const std::filesystem::path path = file + end;
    std::error_code error;
    if (std::filesystem::exists(std::filesystem::symlink_status(path, error)) &&
        !std::filesystem::is_regular_file(path, error))
      throw_store_error(path, EISDIR);
  }
}

}  // namespace

Database::Database(const std::string& file, Access access) {
  expect_files(file);
  // SQLite needs no mutex, because the store has one.
  const int mode = access == Access::read_write  ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE
                   : access == Access::read_only ? SQLITE_OPEN_READONLY
                                                 : SQLITE_OPEN_READONLY | SQLITE_OPEN_URI;
  const auto name = access == Access::immutable ? immutable_uri(file) : file;
  if (sqlite3_open_v2(name.c_str(), &handle_, mode | SQLITE_OPEN_NOMUTEX, nullptr) != SQLITE_OK) {
    const std::string reason = handle_ != nullptr ? sqlite3_errmsg(handle_) : "out of memory";
    const int error_number = handle_ != nullptr ? sqlite3_system_errno(handle_) : 0;
    sqlite3_close(handle_);
    throw_if_disk_full(file, error_number);
    throw StoreError(file + ": " + reason);
  }
  sqlite3_extended_result_codes(handle_, 1);
  sqlite3_busy_timeout(handle_, 5000);
}

Database::~Database() { sqlite3_close(handle_); }

void Database::execute(const char* sql) {
  if (sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail(handle_, sql);
}

Statement::Statement(Database& database, std::string_view sql) : database_(database) {
  if (sqlite3_prepare_v2(database.get(), sql.data(), static_cast<int>(sql.size()), &statement_, nullptr) != SQLITE_OK)
    fail(database.get(), sql);
}

Statement::~Statement() { sqlite3_finalize(statement_); }

bool Statement::step() {
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  fail(database_.get(), "a statement failed");
}

std::string Statement::text(int column) const {
  const auto* bytes = sqlite3_column_text(statement_, column);
  if (bytes == nullptr) return {};
  return {reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
}

std::int64_t Statement::from_0_to(std::int64_t most, int column) const {
  const auto value = integer(column);
  if (value < 0 || value > most) fail_damaged(column, "a whole number from 0 to " + std::to_string(most));
  return value;
}

double Statement::real(int column) const {
  const double value = sqlite3_column_double(statement_, column);
  if (!std::isfinite(value)) fail_damaged(column, "a finite number");
  return value;
}

std::string Statement::json(int column) const {
  auto json = text(column);
  if (!json.empty() && !nlohmann::json::accept(json)) fail_damaged(column, "JSON");
  return json;
}

std::vector<std::string> Statement::texts(int column) const {
  try {
    return nlohmann::json::parse(text(column)).get<std::vector<std::string>>();
  } catch (const nlohmann::json::exception&) {
    fail_damaged(column, "a list of texts");
  }
}

void Statement::fail_damaged(int column, std::string_view wanted) const {
  constexpr std::size_t shown = 40;  // bytes of a value
  // The first column of each record is its id.
  std::string message = "the database is damaged: `" + std::string(sqlite3_column_name(statement_, column)) + "` of `" +
                        text(0).substr(0, shown) + "` is " + text(column).substr(0, shown) + ", not ";
  throw DamagedDatabase(message.append(wanted));
}

void Statement::bind_one(std::string_view value) {
  sqlite3_bind_text(statement_, next_++, value.data() != nullptr ? value.data() : "", static_cast<int>(value.size()),
                    SQLITE_TRANSIENT);
}
void Statement::bind_one(std::int64_t value) { sqlite3_bind_int64(statement_, next_++, value); }
void Statement::bind_one(double value) { sqlite3_bind_double(statement_, next_++, value); }
void Statement::bind_one(std::nullptr_t) { sqlite3_bind_null(statement_, next_++); }

}  // namespace semblante::store

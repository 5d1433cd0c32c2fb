#pragma once

// Private to store/: a thin, safe wrapper of SQLite's C interface.

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <sqlite3.h>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace semblante::store {

enum class Access {
  read_write,  ///< made if it is missing
  read_only,   ///< also while another process writes to it
  immutable,   ///< of a file that nobody writes to, in a folder in which nothing can be made; without its log
};

class Database {
 public:
  /// Throws StoreError.
  explicit Database(const std::string& file, Access access = Access::read_write);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  /// Throws DiskFull or another StoreError for a fault of the disk, else std::runtime_error; so does every function
  /// here that runs SQL.
  void execute(const char* sql);
  [[nodiscard]] sqlite3* get() const { return handle_; }
  /// Number of rows that the last statement changed.
  [[nodiscard]] int changes() const { return sqlite3_changes(handle_); }

 private:
  sqlite3* handle_ = nullptr;
};

/// Revisions, counts, bytes and times of records: one more of each still fits, and JSON has them exactly.
inline constexpr std::int64_t largest_stored_number = (std::int64_t{1} << 53U) - 1;

/// A prepared statement: bind in order, then step row by row, read columns in order. Columns of records are read by
/// whole(), one_of(), real(), json() and texts(), which throw DamagedDatabase for values that no statement of this
/// program writes: SQLite checks types and pages, not values.
class Statement {
 public:
  Statement(Database& database, std::string_view sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  template <class... Values>
  Statement& bind(const Values&... values) {
    (bind_one(values), ...);
    return *this;
  }
  /// True while there is a row.
  bool step();
  /// For statements that return no rows.
  void run() {
    while (step()) {
    }
  }

  [[nodiscard]] std::string text(int column) const;
  /// Any number: of a count, a row or a setting of SQLite.
  [[nodiscard]] std::int64_t integer(int column) const { return sqlite3_column_int64(statement_, column); }
  /// 0 to the largest number of the type, at most largest_stored_number.
  template <std::integral Whole = std::uint64_t>
  [[nodiscard]] Whole whole(int column) const {
    constexpr auto most = std::min<std::uint64_t>(largest_stored_number, std::numeric_limits<Whole>::max());
    return static_cast<Whole>(from_0_to(static_cast<std::int64_t>(most), column));
  }
  /// A value of an enumeration whose values are 0 to `last`.
  template <class Enum>
  [[nodiscard]] Enum one_of(Enum last, int column) const {
    return static_cast<Enum>(from_0_to(static_cast<std::int64_t>(last), column));
  }
  /// A finite number.
  [[nodiscard]] double real(int column) const;
  /// A JSON text, or none.
  [[nodiscard]] std::string json(int column) const;
  /// A list of texts, as JSON.
  [[nodiscard]] std::vector<std::string> texts(int column) const;
  [[nodiscard]] bool is_null(int column) const { return sqlite3_column_type(statement_, column) == SQLITE_NULL; }

 private:
  [[nodiscard]] std::int64_t from_0_to(std::int64_t most, int column) const;
  /// `wanted`: what the column should have had.
  [[noreturn]] void fail_damaged(int column, std::string_view wanted) const;

  void bind_one(std::string_view value);
  void bind_one(const std::string& value) { bind_one(std::string_view(value)); }
  void bind_one(const char* value) { bind_one(std::string_view(value)); }
  void bind_one(std::int64_t value);
  void bind_one(std::uint64_t value) { bind_one(static_cast<std::int64_t>(value)); }
  void bind_one(std::uint32_t value) { bind_one(static_cast<std::int64_t>(value)); }
  void bind_one(int value) { bind_one(static_cast<std::int64_t>(value)); }
  void bind_one(double value);
  void bind_one(std::nullptr_t);
  template <class T>
  void bind_one(const std::optional<T>& value) {
    if (value)
      bind_one(*value);
    else
      bind_one(nullptr);
  }

  Database& database_;
  sqlite3_stmt* statement_ = nullptr;
  int next_ = 1;
};

/// BEGIN IMMEDIATE in the constructor, COMMIT by commit(), otherwise ROLLBACK in the destructor.
class Transaction {
 public:
  explicit Transaction(Database& database) : database_(database) { database_.execute("BEGIN IMMEDIATE"); }
  ~Transaction() {
    if (!committed_) sqlite3_exec(database_.get(), "ROLLBACK", nullptr, nullptr, nullptr);
  }
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit() {
    database_.execute("COMMIT");
    committed_ = true;
  }

 private:
  Database& database_;
  bool committed_ = false;
};

}  // namespace semblante::store

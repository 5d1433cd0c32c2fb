// What a store is not opened on: a database of another program, what is no database, what another program holds.

#include <fstream>
#include <iterator>
#include <sqlite3.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "server/store/sqlite_schema.h"
#include "tests/unit/store/store_fixture.h"

namespace semblante::store {
namespace {

/// Runs SQL on a database of its own, and closes it at the end of the scope.
class OtherProgram {
 public:
  OtherProgram(const std::filesystem::path& file, const char* sql) {
    EXPECT_EQ(sqlite3_open(file.c_str(), &database_), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(database_, sql, nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(database_);
  }
  ~OtherProgram() { sqlite3_close(database_); }
  OtherProgram(const OtherProgram&) = delete;
  OtherProgram& operator=(const OtherProgram&) = delete;

 private:
  sqlite3* database_ = nullptr;
};

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

TEST_F(StoreTest, DatabaseOfAnotherProgram_IsRefused_AndNotChanged) {
  for (const int version : {0, 3, current_schema_version(), 99}) {
    SCOPED_TRACE(version);
    const auto file = folder_ / ("letters-" + std::to_string(version) + ".sqlite");
    const auto sql = "CREATE TABLE letters(text TEXT); PRAGMA user_version=" + std::to_string(version);
    const OtherProgram theirs(file, sql.c_str());
    const auto before = bytes_of(file);
    const auto opened = open_sqlite_store(file);
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().where, file.string());
    EXPECT_EQ(opened.error().message, "it is the database of another program");
    EXPECT_EQ(bytes_of(file), before);
  }
}

TEST_F(StoreTest, VersionBelowAllOfThisProgram_IsRefused) {
  const auto file = folder_ / "below.sqlite";
  const OtherProgram theirs(file, "CREATE TABLE models(text TEXT); PRAGMA user_version=-1");
  const auto opened = open_sqlite_store(file);
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().message, "it is the database of another program");
}

TEST_F(StoreTest, WhatCannotBeOpened_IsSaidInWords_WithItsNameOnce) {
  const auto text = folder_ / "text.sqlite", held = folder_ / "held.sqlite", pipe = folder_ / "pipe.sqlite";
  std::ofstream(text) << std::string(5000, 'x');
  const OtherProgram theirs(held, "CREATE TABLE letters(text TEXT); BEGIN EXCLUSIVE");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const auto error_of = [](const std::filesystem::path& file) {
    const auto opened = open_sqlite_store(file);
    EXPECT_FALSE(opened);
    return opened ? std::string() : opened.error().where + ": " + opened.error().message;
  };
  EXPECT_THAT(error_of(text), ::testing::StartsWith(text.string() + ": it is no database, or a damaged one"));
  EXPECT_EQ(error_of(held), held.string() + ": another program has it open and holds it");
  EXPECT_EQ(error_of(pipe), ": " + pipe.string() + ": a FIFO is in its place");
}

}  // namespace
}  // namespace semblante::store

// A disk that is full or fails under the store: nothing changes, the fault has a type, and the next call is as if
// nothing had been.
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <functional>
#include <sqlite3.h>
#include <unistd.h>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "server/store/blob_store.h"
#include "server/store/sqlite_store.h"
#include "tests/support/failing_database.h"

namespace semblante::store {
namespace {

using test::fail_database_writes;
using test::FullDatabaseDisk;

class FullDiskStoreTest : public ::testing::Test {
 protected:
  FullDiskStoreTest() {
    fail_database_writes(SQLITE_OK);
    std::string name = (std::filesystem::temp_directory_path() / "semblante-store-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    reopen();
  }
  ~FullDiskStoreTest() override {
    store_.reset();
    std::filesystem::remove_all(folder_);
  }
  void reopen() {
    store_.reset();
    store_ = *open_sqlite_store(folder_ / "facts.sqlite");
  }
  static StreamRecord stream(const std::string& id) { return {id, timestamp_now(), {}}; }

  std::filesystem::path folder_;
  std::unique_ptr<Store> store_;
};

TEST_F(FullDiskStoreTest, Writes_ThrowDiskFull_AndChangeNothing) {
  ASSERT_TRUE(store_->create_stream(stream("kept"), std::nullopt));
  JobRecord job;
  job.id = "x";
  job.kind = "extract";
  store_->create_job(job, {}, std::nullopt);
  store_->create_set({"s", "Grin", "viseme", 1, "t", "t", "{}", "{}"}, std::nullopt);
  RecordingRecord recording;
  recording.id = "r";
  store_->create_recording(recording, std::nullopt);
  recording.state = RecordingState::finished;
  auto failed = job;
  failed.state = JobState::failed;
  const std::vector<std::function<void()>> writes = {
      [&] { store_->create_stream(stream("other"), std::nullopt); },
      [&] { store_->remove_stream("kept"); },
      [&] { store_->update_job(failed); },
      [&] { store_->finish_job(failed); },
      [&] {
        store_->finish_extraction(failed, {"t", "Smile", "viseme", 1, "t", "t", "{}", "{}"});
      },
      [&] { store_->request_cancel("x"); },
      [&] {
        store_->put_set({"s", "Frown", "viseme", 1, "t", "t", "{}", "{}"});
      },
      [&] { store_->remove_set("s"); },
      [&] { store_->finish_recording(recording); },
      [&] { store_->remove_recording("r"); },
      [&] { store_->check_writable(); }};
  const auto unchanged = [&] {
    EXPECT_EQ(store_->streams().size(), 1U);
    EXPECT_EQ(store_->job("x"), job);
    EXPECT_EQ(store_->set("s")->name, "Grin");
    EXPECT_EQ(store_->set_count(), 1U);
    EXPECT_EQ(store_->recording("r")->state, RecordingState::recording);
  };
  for (std::size_t i = 0; i < writes.size(); ++i) {
    fail_database_writes(SQLITE_FULL);
    EXPECT_THROW(writes[i](), DiskFull) << i;
    fail_database_writes(SQLITE_IOERR_WRITE);
    try {
      writes[i]();
      ADD_FAILURE() << i << " did not fail";
    } catch (const DiskFull&) {
      ADD_FAILURE() << i << " says that the disk is full";
    } catch (const StoreError&) {
    }
    unchanged();
  }
  fail_database_writes(SQLITE_OK);
  reopen();
  unchanged();
  for (const auto& write : writes) EXPECT_NO_THROW(write());
}

TEST_F(FullDiskStoreTest, OpensAndReads_OnAFullDisk) {
  store_->create_stream(stream("kept"), std::nullopt);
  store_.reset();
  {
    const FullDatabaseDisk full;
    store_ = *open_sqlite_store(folder_ / "facts.sqlite");
    EXPECT_EQ(store_->streams().size(), 1U);
    EXPECT_THROW(store_->remove_stream("kept"), DiskFull);
  }
  EXPECT_TRUE(store_->remove_stream("kept")) << "there is room again";
  reopen();
  EXPECT_TRUE(store_->streams().empty());
}

TEST_F(FullDiskStoreTest, OrderlyEnd_LeavesAnEmptyLog) {
  store_->create_stream(stream("kept"), std::nullopt);
  store_.reset();
  const auto log = folder_ / "facts.sqlite-wal";
  ASSERT_TRUE(std::filesystem::exists(log)) << "a full disk may have no room for a new one";
  EXPECT_EQ(std::filesystem::file_size(log), 0U) << "it would be applied to another database put in this one's place";
}

TEST_F(FullDiskStoreTest, ANewStore_CannotBeMadeOnAFullDisk) {
  const FullDatabaseDisk full;
  EXPECT_THROW(static_cast<void>(open_sqlite_store(folder_ / "new.sqlite")), DiskFull);
}

TEST_F(FullDiskStoreTest, RequestedCancel_StaysUntilTheJobEnds) {
  JobRecord job;
  job.id = "x";
  job.kind = "extract";
  store_->create_job(job, {}, std::nullopt);
  EXPECT_TRUE(store_->request_cancel("x"));
  job.state = JobState::running;
  job.stage = "starting";
  store_->update_job(job);
  EXPECT_EQ(store_->job("x")->stage, cancelling_stage) << "whatever its queue says meanwhile";
  job.state = JobState::cancelled;
  job.stage = "";
  store_->finish_job(job);
  EXPECT_EQ(store_->job("x")->stage, "");
  EXPECT_FALSE(store_->request_cancel("x")) << "it has ended";
  EXPECT_FALSE(store_->request_cancel("absent"));
}

TEST(BlobStoreStart, KeepsItsFolderForUploads) {
  std::string name = (std::filesystem::temp_directory_path() / "semblante-blobs-XXXXXX").string();
  const std::filesystem::path folder = mkdtemp(name.data());
  BlobStore::open(folder);
  std::filesystem::create_directories(folder / "tmp" / "job-1");
  const auto made = [&] {
    struct stat facts {};
    ::stat((folder / "tmp").c_str(), &facts);
    return facts.st_ino;
  };
  const auto before = made();
  const int held = ::open((folder / "tmp").c_str(), O_RDONLY | O_DIRECTORY);  // so that its number is not given again
  BlobStore::open(folder);
  EXPECT_EQ(made(), before) << "a full disk has no room for a new one";
  EXPECT_TRUE(std::filesystem::is_empty(folder / "tmp"));
  ::close(held);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace semblante::store
